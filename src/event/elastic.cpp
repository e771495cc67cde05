#include "elastic.hpp"

#include "../digits.hpp"
#include "slipfront/medium/medium.hpp"

namespace slipfront::event {

Elastic elastic(const medium::Constants& o, const MediumDefaults& d, std::string* assumed) {
  const auto assume = [&](double value, const char* key, const char* unit, bool stated) {
    if (!stated && assumed) *assumed += (assumed->empty() ? "" : ", ") + (key + (" " + digits(value)) + unit);
    return value;
  };
  Elastic e{};
  const bool both_speeds = o.p_wave_speed && o.s_wave_speed;
  e.poisson_ratio = o.poisson_ratio ? *o.poisson_ratio
                    : both_speeds   ? medium::poisson_ratio(*o.p_wave_speed, *o.s_wave_speed)
                                    : assume(d.poisson_ratio, "poisson_ratio", "", d.stated_poisson);
  const bool by_modulus = o.shear_modulus && o.density;
  e.speed = o.p_wave_speed   ? medium::speed_from_p_wave(*o.p_wave_speed, e.poisson_ratio)
            : o.s_wave_speed ? medium::speed_from_s_wave(*o.s_wave_speed, e.poisson_ratio)
            : by_modulus     ? medium::speed_from_shear_modulus(*o.shear_modulus, *o.density, e.poisson_ratio)
                             : medium::speed_from_p_wave(assume(d.p_wave_speed, "p_wave_speed", " m/s", d.stated_speed),
                                                         e.poisson_ratio);
  e.shear_modulus = o.shear_modulus               ? *o.shear_modulus
                    : o.s_wave_speed && o.density ? *o.density * *o.s_wave_speed * *o.s_wave_speed
                                                  : assume(d.shear_modulus, "shear_modulus", " Pa", d.stated_modulus);
  return e;
}

}  // namespace slipfront::event
