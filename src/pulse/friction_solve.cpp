#include "friction_solve.hpp"

#include <cmath>
#include <numbers>

#include "slipfront/modulation/per_dislocation.hpp"

namespace slipfront::pulse {
namespace {

constexpr double precision = 1e-12;  ///< of the momentum, or of the force where friction takes nearly all
/// What friction leaves less of than this part of what would be there without it, is at rest.
constexpr double at_rest_below = 1e-12;

/// The root of excess(size e^x), over which the force of a regularised law changes evenly: secants that keep the
/// bracket; one that moves the same end twice gives the other half its weight (the Illinois rule).
template <class Excess>
double root_between(double low, double high, double at_low, double at_high, double size, const Excess& excess) {
  double x = high;
  int side = 0;
  for (int i = 0; i < 100 && high - low > 1e-13 * std::fmax(1, -low); ++i) {
    x = (low * at_high - high * at_low) / (at_high - at_low);
    if (!(x > low && x < high)) x = (low + high) / 2;
    const double at = excess(size * std::exp(x));
    if (std::fabs(at) <= precision * size) break;
    if (at > 0) {
      high = x;
      at_high = at;
      if (side > 0) at_low /= 2;
      side = 1;
    } else {
      low = x;
      at_low = at;
      if (side < 0) at_high /= 2;
      side = -1;
    }
  }
  return x;
}

}  // namespace

double typical_speed(const State& state, double contact) {
  return contact * std::sinh(std::fabs(state.phi)) * std::exp(state.psi);
}

SlowedTrain::Left SlowedTrain::after(double free, double time) const {
  const double size = std::fabs(free), weight = 2 * std::numbers::pi * time;
  if (size == 0) return {0, 0, 0};
  State state{};
  const auto excess = [&](double momentum) {
    state = modulation::state_of({contact * spacing, momentum / contact}, psi_guess);
    return momentum + weight * friction.mean_strength(state, contact, memory) - size;
  };
  const auto with_sign = [&](double momentum) {
    return Left{std::copysign(momentum, free), std::copysign(std::tanh(state.phi), free),
                typical_speed(state, contact)};
  };
  const double slowest = at_rest_below * size;
  double at_slowest = 0;
  if (at_rest && (at_slowest = excess(slowest)) >= 0) return {0, 0, 0};
  // Where friction takes little, by secants from above.
  double high = size, at_high = excess(high);
  const double first = at_high;
  if (at_high <= precision * size) return with_sign(high);
  double momentum = high - at_high;
  for (int i = 0; i < 12 && momentum > size / 2; ++i) {
    const double at = excess(momentum);
    if (std::fabs(at) <= precision * size) return with_sign(momentum);
    const double slope = (at_high - at) / (high - momentum);
    high = momentum;
    at_high = at;
    momentum -= at / std::fmax(slope, 0.5);
  }
  if (!at_rest && (at_slowest = excess(slowest)) >= 0) return {0, 0, 0};
  momentum = size * std::exp(root_between(std::log(at_rest_below), 0, at_slowest, first, size, excess));
  return with_sign(momentum);
}

}  // namespace slipfront::pulse
