#include "inference/balance.hpp"

#include <cmath>

#include "slipfront/inference/posterior.hpp"

namespace slipfront::inference {

using catalogue::Measure;

namespace {

/// Root of a monotone function between `low` and `high`, where `f` has opposite signs: Newton, by halves where it
/// leaves the bracket. `f` returns value and slope.
template <class F>
double root(double low, double high, double guess, bool rising, const F& f) {
  double x = guess;
  for (int i = 0; i < 60; ++i) {
    const auto [value, slope] = f(x);
    if (std::fabs(value) < 1e-12) break;
    ((value > 0) == rising ? high : low) = x;
    const double next = x - value / slope;
    const double to = next > low && next < high ? next : low + (high - low) / 2;
    if (std::fabs(to - x) < 1e-13 * (1 + std::fabs(x))) break;
    x = to;
  }
  return x;
}

}  // namespace

Pulse::At Pulse::at(double u) const {
  const double damping = std::expm1(u);
  const friction_ratio::Ratio r = friction_ratio::evaluate(measure, closure, stress, damping);
  return {frictionless * r.value, (1 + damping) * r.by_damping / r.value};
}

double frictionless(Measure measure, double stress, double W_at_origin) {
  if (measure != Measure::mean) return W_at_origin;
  const auto range = friction_ratio::stress_range();
  const double tabled = std::fmin(std::fmax(stress, range.least), range.most);
  return W_at_origin * friction_ratio::evaluate(measure, friction::Closure::consistent, tabled, 0).value;
}

std::optional<Damped> damping_at(const Pulse& pulse, double W) {
  const double most = std::log1p(most_damping_number), wanted = std::log(W);
  if (!(W <= pulse.at(0).W) || !(W >= pulse.at(most).W)) return std::nullopt;
  double slope = 0;
  // Late W falls as Gamma^(-1/2), early less: a guess that is never far off.
  const double guess = std::fmin(2 * std::log1p(pulse.at(0).W / W - 1), most);
  const double u = root(0, most, guess, false, [&](double x) {
    const Pulse::At a = pulse.at(x);
    slope = a.slope;
    return std::pair(std::log(a.W) - wanted, a.slope);
  });
  return Damped{u, slope};
}

std::optional<Balanced> contact_at(const Pulse& pulse, double product, double per_contact, double least, double most) {
  const double wanted = std::log(product);
  double u = 0, slope = 0;
  const auto excess = [&](double ln_A) {
    const double damping = std::exp(ln_A) * per_contact;
    u = std::log1p(damping);
    const Pulse::At a = pulse.at(u);
    slope = a.slope;
    return std::pair(ln_A + std::log(a.W) - wanted, 1 + a.slope * damping / (1 + damping));
  };
  const double low = std::log(least), high = std::log(most);
  if (!(excess(low).first <= 0 && excess(high).first >= 0)) return std::nullopt;
  const double ln_A = root(low, high, wanted - std::log(pulse.frictionless), true, excess);
  excess(ln_A);
  return Balanced{std::exp(ln_A), u, slope};
}

}  // namespace slipfront::inference
