#pragma once

#include <cmath>
#include <cstdlib>
#include <optional>

#include "slipfront/events/catalogue/observation.hpp"
#include "slipfront/events/inference/estimate.hpp"

/// Aborts if a reader let through what it should have refused, or if the theory makes of it what is no number.
inline void check_observation(const slipfront::catalogue::Observation& o) {
  const auto require = [](bool truth) {
    if (!truth) std::abort();
  };
  for (const auto& measured : {o.rupture_velocity_m_s, o.slip_velocity_m_s, o.slip, o.rise_time, o.duration})
    if (measured) require(measured->low > 0 && measured->low <= measured->high && std::isfinite(measured->high));
  for (const auto& constant :
       {o.shear_modulus, o.p_wave_speed, o.s_wave_speed, o.density, o.contact_ratio, o.asperity_spacing})
    if (constant) require(*constant > 0 && std::isfinite(*constant));
  if (o.poisson_ratio) require(std::isfinite(*o.poisson_ratio));
  require(!o.name.empty());
  try {
    const slipfront::inference::Estimate e = slipfront::inference::estimate(o, {});
    for (const auto& x : {e.rupture_velocity, e.stress, e.frictionless_slip_velocity, e.observed_slip_velocity,
                          e.slip_velocity_ratio, e.contact_ratio, e.stress_pa}) {
      if (!x) continue;
      require(std::isfinite(x->value) && x->value >= 0);
      if (x->interval) require(x->interval->low < x->interval->high && std::isfinite(x->interval->high));
    }
  } catch (const slipfront::InputError&) {
  }
}
