#include "events/inference/sampling/pulse_state.hpp"

#include <algorithm>
#include <cmath>

#include "math/roots.hpp"
#include "slipfront/events/inference/posterior.hpp"
#include "slipfront/math/elliptic.hpp"
#include "slipfront/theory/rupture/relations.hpp"

namespace slipfront::inference {

using catalogue::Observation;
using catalogue::RuptureVelocityIs;
using catalogue::SlipVelocityKind;
using catalogue::StressDropIs;
using friction_ratio::Drop;
using friction_ratio::stress_range;

namespace {

/// ln |V-| and Sigma- at psi, with their slopes by ln psi (Eqs. 8-10).
struct Front {
  double ln_V, V_slope, stress, stress_slope;
};
Front front_at(double psi) {
  const elliptic::AtPsi at = elliptic::at_psi(psi);
  const double m = (1 - at.s) * (1 + at.s), K_slope = elliptic::log_slope_of_K(at), E_slope = at.s * (1 / at.ratio - 1);
  const double stress = std::acos(-1.0) * std::cosh(psi) / at.K;
  return {std::log(at.s / at.ratio), psi * (m / at.s + K_slope - E_slope), stress, stress * psi * (at.s - K_slope)};
}

/// A first guess of psi, from |V-| = psi ln(4 / psi) for small psi.
double rough_psi(double V) {
  const double log = std::log(4 / V);
  return V / (log + std::log(std::fmax(log, 1.0)));
}

}  // namespace

double frictionless(SlipVelocityKind measure, double stress, double W_at_origin) {
  if (measure != SlipVelocityKind::mean) return W_at_origin;
  const auto range = stress_range();
  const double tabled = std::fmin(std::fmax(stress, range.least), range.most);
  return W_at_origin * friction_ratio::evaluate(measure, friction::Closure::consistent, tabled, 0).value;
}

PulseModel::PulseModel(const Observation& o, friction::Closure closure)
    : measure_(o.measure()),
      closure_(closure),
      sees_front_(o.rupture_velocity_is == RuptureVelocityIs::front),
      static_drop_(o.stress_drop && o.stress_drop_is == StressDropIs::static_drop),
      front_(closure, o.front_threshold) {
  static const rupture::Relations least = rupture::from_stress(stress_range().least);
  static const rupture::Relations most = rupture::from_stress(stress_range().most);
  least_psi_ = least.psi;
  most_psi_ = most.psi;
  least_ln_V_ = std::log(least.rupture_velocity);
  most_ln_V_ = std::log(most.rupture_velocity);
  least_seen_ = least.rupture_velocity * (sees_front_ ? front_(least.stress, 0).value : 1);
  most_seen_ = most.rupture_velocity * (sees_front_ ? front_(most.stress, 0).value : 1);
}

double PulseModel::most_u(double seen) const {
  static const double most_damping_u = std::log1p(most_damping_number);
  if (!(seen >= least_seen_ && seen <= most_seen_)) return no_pulse;
  if (!sees_front_) return most_damping_u;
  const double ratio = seen / most_seen_ * front_(stress_range().most, 0).value;
  const auto excess = [&](double u) {
    const double damping = std::expm1(u);
    const friction_ratio::Ratio r = front_(stress_range().most, damping);
    return std::pair(std::log(r.value / ratio), (1 + damping) * r.by_damping / r.value);
  };
  if (excess(most_damping_u).first >= 0) return most_damping_u;
  return bracketed_newton(0, most_damping_u, std::fmin(2 * std::log1p(1 / ratio), most_damping_u), false, excess);
}

PulseState PulseModel::state(const rupture::Relations& r, double slope, double damping) const {
  const double stress = std::clamp(r.stress, stress_range().least, stress_range().most);
  return {.rupture_velocity = r.rupture_velocity,
          .stress = r.stress,
          .frictionless = r.slip_velocity,
          .W = r.slip_velocity * friction_ratio::evaluate_value(measure_, closure_, stress, damping),
          .drop_share = static_drop_ ? drop_share(stress, damping) : 1,
          .slope = slope};
}

double PulseModel::static_share(double stress, double u) const {
  return drop_share(std::clamp(stress, stress_range().least, stress_range().most), std::expm1(u));
}

double PulseModel::drop_share(double stress, double damping) const {
  return friction_ratio::stress_drop_share(Drop::origin, closure_, stress, damping).value;
}

PulseState PulseModel::at(double seen, double u) const {
  const double damping = std::expm1(u), wanted = std::log(seen);
  if (!sees_front_) return state(rupture::from_rupture_velocity(seen), 1, damping);
  const friction_ratio::FrontAtDamping front = front_.at_damping(damping);
  double slope = 1;
  const auto excess = [&](double ln_psi) {
    const Front f = front_at(std::exp(ln_psi));
    const friction_ratio::Ratio r = front(std::clamp(f.stress, stress_range().least, stress_range().most));
    const double by_psi = f.V_slope + r.by_stress / r.value * f.stress_slope;
    slope = f.V_slope / by_psi;
    return std::pair(f.ln_V + std::log(r.value) - wanted, by_psi);
  };
  const double ratio = front(1).value;
  const double guess = std::clamp(rough_psi(std::fmin(seen / ratio, 0.99)), least_psi_, most_psi_);
  const double ln_psi = bracketed_newton(std::log(least_psi_), std::log(most_psi_), std::log(guess), true, excess);
  return state(rupture::from_psi(std::exp(ln_psi)), slope, damping);
}

PulseState PulseModel::of_prior(double share, double u) const {
  const double V = std::exp(least_ln_V_ + share * (most_ln_V_ - least_ln_V_));
  return state(rupture::from_rupture_velocity(V), 1, std::expm1(u));
}

double PulseModel::seen_without_friction(double stress) const {
  return rupture::from_stress(stress).rupture_velocity * (sees_front_ ? front_(stress, 0).value : 1);
}

double PulseModel::seen(const PulseState& p, double u) const {
  if (!sees_front_) return p.rupture_velocity;
  const double stress = std::clamp(p.stress, stress_range().least, stress_range().most);
  return p.rupture_velocity * front_(stress, std::expm1(u)).value;
}

PulseState PulseModel::without_friction(double seen) const {
  const rupture::Relations r = rupture::from_rupture_velocity(seen);
  return {.rupture_velocity = r.rupture_velocity,
          .stress = r.stress,
          .frictionless = r.slip_velocity,
          .W = frictionless(measure_, r.stress, r.slip_velocity),
          .drop_share = static_drop_ ? 1 - r.stress_at_origin / r.stress : 1,
          .slope = 1};
}

}  // namespace slipfront::inference
