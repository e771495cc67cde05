#include "foundation/text/digits.hpp"
#include "slipfront/error.hpp"
#include "slipfront/medium/constants.hpp"
#include "slipfront/medium/medium.hpp"
#include "slipfront/medium/quantity.hpp"

namespace slipfront::medium {

Elastic elastic(const Constants& o, const Defaults& d, std::string* assumed) {
  const auto assume = [&](double value, const char* key, const char* unit, bool stated) {
    if (!stated && assumed) *assumed += (assumed->empty() ? "" : ", ") + (key + (" " + digits(value)) + unit);
    return value;
  };
  Elastic e{};
  const bool both_speeds = o.p_wave_speed && o.s_wave_speed;
  e.poisson_ratio = o.poisson_ratio ? *o.poisson_ratio
                    : both_speeds   ? poisson_ratio(*o.p_wave_speed, *o.s_wave_speed)
                                    : assume(d.poisson_ratio, "poisson_ratio", "", d.stated_poisson);
  const bool by_modulus = o.shear_modulus && o.density;
  e.speed = o.p_wave_speed   ? speed_from_p_wave(*o.p_wave_speed, e.poisson_ratio)
            : o.s_wave_speed ? speed_from_s_wave(*o.s_wave_speed, e.poisson_ratio)
            : by_modulus
                ? speed_from_shear_modulus(*o.shear_modulus, *o.density, e.poisson_ratio)
                : speed_from_p_wave(assume(d.p_wave_speed, "p_wave_speed", " m/s", d.stated_speed), e.poisson_ratio);
  e.shear_modulus = o.shear_modulus               ? *o.shear_modulus
                    : o.s_wave_speed && o.density ? *o.density * *o.s_wave_speed * *o.s_wave_speed
                                                  : assume(d.shear_modulus, "shear_modulus", " Pa", d.stated_modulus);
  return e;
}

namespace {

/// Reads one stated constant, if it was stated. \throws InputError that names the option.
void read_stated(const std::string& text, const char* option, Dimension dimension, double& value, bool& is_stated) {
  if (text.empty()) return;
  try {
    const auto span = parse_quantity(text, dimension);
    if (span.low < span.high)
      throw InputError({.value = text,
                        .problem = "a range, where one number is needed",
                        .allowed = std::string(example(dimension))});
    const bool is_ratio = dimension == Dimension::ratio;
    if (is_ratio ? !(span.low > -1 && span.low < 0.5) : !(span.low > 0))
      throw InputError(
          {.value = text, .problem = "out of range", .allowed = is_ratio ? "-1 < poisson_ratio < 0.5" : "> 0"});
    value = span.low;
    is_stated = true;
  } catch (const InputError& error) {
    Complaint c = error.complaint();
    c.file = "command line";
    c.key = option;
    throw InputError(c);
  }
}

}  // namespace

Defaults defaults_of(const StatedDefaults& stated) {
  Defaults d;
  read_stated(stated.p_wave_speed, "--p-wave-speed", Dimension::velocity, d.p_wave_speed, d.stated_speed);
  read_stated(stated.poisson_ratio, "--poisson-ratio", Dimension::ratio, d.poisson_ratio, d.stated_poisson);
  read_stated(stated.shear_modulus, "--shear-modulus", Dimension::pressure, d.shear_modulus, d.stated_modulus);
  return d;
}

}  // namespace slipfront::medium
