// Steps in which friction at the faces is implicit, and all else explicit.

#include <cmath>

#include "slipfront/pulse/named_values.hpp"
#include "staggered.hpp"

namespace slipfront::pulse {

/// The rapidity that friction leaves in a time of the momentum `free` > 0 of one dislocation:
/// M(phi) (1 + time rate(phi)) = free, solved in logarithms, in which it is nearly a straight line for any power of the
/// velocity. Secants keep the bracket; one that moves the same end twice gives the other half its weight. 0 where the
/// velocity is less than a double holds.
double Staggered::rapidity_after(std::size_t f, double free, double time) const {
  constexpr double slowest = -690, precision = 1e-13;
  const double mass = face_mass_[f];
  const auto excess = [&](double log_phi) {
    const double phi = std::exp(log_phi);
    return std::log(mass * std::sinh(phi) / free) + std::log1p(time * loss_rate(f, phi));
  };
  double high = std::log(std::asinh(free / mass)), low = slowest;
  if (!(high > low)) return 0;
  double at_high = excess(high), at_low = excess(low);
  if (at_high <= 0) return std::exp(high);
  if (at_low >= 0) return 0;
  double x = high;
  int side = 0;
  for (int i = 0; i < 100 && high - low > precision; ++i) {
    x = (low * at_high - high * at_low) / (at_high - at_low);
    if (!(x > low && x < high)) x = (low + high) / 2;
    const double at = excess(x);
    if (std::fabs(at) <= precision) break;
    const int now = at > 0 ? 1 : -1;
    (at > 0 ? high : low) = x;
    (at > 0 ? at_high : at_low) = at;
    if (side == now) (at > 0 ? at_low : at_high) /= 2;
    side = now;
  }
  return std::exp(x);
}

void Staggered::split_step(double t, double dt, const double* z, double* next) {
  const ConstFaceValues now(z, faces());
  const FaceValues then(next, faces());
  find_masses(t, z);
  then.dissipated() = now.dissipated();
  then.supplied() = now.supplied();
  then.through_ends() = now.through_ends();
  double before = 0;
  for (std::size_t f = 0; f < faces(); ++f) {
    const double push = push_on(f, t), q = charge_around(f);
    const double cosh_phi = std::sqrt(1 + std::pow(on_one_[f] / face_mass_[f], 2));
    const double force = setup_.contact ? force_on(f) / cosh_phi : force_on(f);
    const double free = now.momentum(f) + dt * held_by_wall(f, force + push);
    const double phi = free == 0 ? 0 : rapidity_after(f, std::fabs(free) / q, dt);
    const double U = std::copysign(std::tanh(phi), free);
    const double momentum = std::copysign(q * face_mass_[f] * std::sinh(phi), free);
    then.momentum(f) = momentum;
    then.width_left_of(f) = now.width_left_of(f) + dt * (U - before);
    then.dissipated() += U * (free - momentum);
    then.supplied() += dt * U * push;
    then.through_ends() += dt * power_through(f, U);
    before = U;
  }
}

}  // namespace slipfront::pulse
