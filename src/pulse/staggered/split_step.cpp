// Steps in which friction at the faces is implicit, and all else explicit.

#include <algorithm>
#include <cmath>
#include <vector>

#include "pulse/grid/values.hpp"
#include "pulse/staggered/staggered.hpp"

namespace slipfront::pulse {

/// Finds sinh(phi) at the faces after friction has acted for a time on the momenta `free` >= 0 of single dislocations:
/// M(phi) (1 + time rate(phi)) = free, solved in logarithms, in which it is nearly a straight line for any power of the
/// velocity. sinh(phi) is 0 where the velocity is less than a double holds.
void Staggered::slow_down(const std::vector<double>& free, double time) {
  constexpr double slowest = -690, precision = 1e-13;
  constexpr int most_tries = 100;
  brackets_.clear();
  for (std::size_t f = 0; f < faces(); ++f) {
    FaceBracket b{{.low = slowest, .high = std::log(free[f] / face_mass_[f])}};
    b.done = !(b.high > b.low);
    b.x = b.done ? slowest : b.high;
    brackets_.push_back(b);
  }
  const auto take_excess = [&](const auto& take) {
    for (std::size_t f = 0; f < faces(); ++f) sinh_phi_[f] = std::exp(brackets_[f].x);
    find_loss_rates();
    for (std::size_t f = 0; f < faces(); ++f) {
      FaceBracket& b = brackets_[f];
      if (!b.done) take(b, std::log(face_mass_[f] / free[f]) + b.x + std::log1p(time * loss_rate_[f]));
    }
  };
  take_excess([](FaceBracket& b, double excess) {
    b.at_high = excess;
    b.done = excess <= precision;
    if (!b.done) b.x = b.low;
  });
  take_excess([](FaceBracket& b, double excess) {
    b.at_low = excess;
    b.done = excess >= 0;
    if (!b.done) b.aim();
  });
  const auto all_done = [&] {
    return std::all_of(brackets_.begin(), brackets_.end(), [](const FaceBracket& b) { return b.done; });
  };
  for (int i = 0; i < most_tries && !all_done(); ++i)
    take_excess([](FaceBracket& b, double excess) {
      b.done = std::fabs(excess) <= precision || b.high - b.low <= precision;
      if (b.done) return;
      b.take(excess);
      b.aim();
    });
  for (std::size_t f = 0; f < faces(); ++f) sinh_phi_[f] = brackets_[f].x > slowest ? std::exp(brackets_[f].x) : 0;
}

void Staggered::split_step(double t, double dt, const double* z, double* next) {
  const ConstFaceValues now(z, faces());
  const FaceValues then(next, faces());
  find_masses(t, z);
  then.dissipated() = now.dissipated();
  then.supplied() = now.supplied();
  then.through_ends() = now.through_ends();
  std::vector<double>&free = free_, &of_one = free_on_one_, &pushes = pushes_;
  for (std::size_t f = 0; f < faces(); ++f) {
    pushes[f] = push_on(f, t);
    const double cosh_phi = std::sqrt(1 + std::pow(on_one_[f] / face_mass_[f], 2));
    const double force = setup_.contact ? force_on(f) / cosh_phi : force_on(f);
    free[f] = now.momentum(f) + dt * held_by_wall(f, force + pushes[f]);
    of_one[f] = std::fabs(free[f]) / charge_around(f);
  }
  slow_down(of_one, dt);
  double before = 0;
  for (std::size_t f = 0; f < faces(); ++f) {
    const double U = std::copysign(sinh_phi_[f] / std::sqrt(1 + sinh_phi_[f] * sinh_phi_[f]), free[f]);
    then.momentum(f) = std::copysign(charge_around(f) * face_mass_[f] * sinh_phi_[f], free[f]);
    then.width_left_of(f) = now.width_left_of(f) + dt * (U - before);
    then.dissipated() += U * (free[f] - then.momentum(f));
    then.supplied() += dt * U * pushes[f];
    then.through_ends() += dt * power_through(f, U);
    before = U;
  }
}

}  // namespace slipfront::pulse
