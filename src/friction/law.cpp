// What holds for any law: averages by quadrature, the implicit solve by bracketing.

#include "slipfront/friction/law.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>

#include "foundation/simd/vector_code.hpp"
#include "friction/train_means.hpp"
#include "slipfront/elliptic/complete.hpp"
#include "slipfront/error.hpp"

namespace slipfront::friction {
namespace {

using std::numbers::pi;

/// Mean of the law's force over half a period, u / 2 from 0 to pi / 2, where
///     w = 2 a sinh |phi| sqrt(sinh^2 psi + sin^2(u / 2)).
/// With pi / 2 - u / 2 = gd(y), the scale psi at u = 0 becomes a decaying tail, and the trapezoidal rule converges
/// exponentially for smooth laws. In y, du goes as sech y dy and dx as du / w.
double mean_of_force(const Law& law, const State& state, double contact, Closure closure, Memory memory) {
  constexpr double tail = 40, h = 1.0 / 8;
  const double s = std::tanh(state.psi), decay = std::exp(-h);
  const double fastest = 2 * contact * std::sinh(std::fabs(state.phi)) * std::cosh(state.psi);
  const double end = closure == Closure::consistent ? tail : tail + std::log1p(1 / s);
  double sum = 0, weights = 0, e = 1;  // e = exp(-y)
  for (int i = 0; i * h <= end; ++i, e *= decay) {
    const double sech = 2 * e / (1 + e * e), tanh = (1 - e * e) / (1 + e * e);
    const double relative = std::hypot(sech, s * tanh);  // w over the fastest w
    const double weight = (i == 0 ? 0.5 : 1) * (closure == Closure::consistent ? sech : sech / relative);
    sum += weight * law.strength(fastest * relative, memory);
    weights += weight;
  }
  return sum / weights;
}

/// From the mean force, with P / k = 8 sinh phi cosh psi E / 2 pi.
class RateByQuadrature final : public RelaxationRate {
 public:
  RateByQuadrature(const Law& law, Closure closure) : law_(law), closure_(closure) {}
  double operator()(const State& state, double contact, Memory memory) const override {
    if (state.empty()) return 0;
    const double phi = state.phi == 0 ? 1e-8 * std::fmin(state.psi, 1.0) : std::fabs(state.phi);  // the limit at rest
    const double momentum = 8 * contact * std::sinh(phi) * std::cosh(state.psi) * elliptic::at_psi(state.psi).E;
    return 2 * pi * law_.mean_strength({phi, state.psi}, contact, closure_, memory) / momentum;
  }

 private:
  const Law& law_;
  Closure closure_;
};

/// Many solves of v + weight f(v) = free at once, by secants. `before` and `excess` are the last place and what the
/// left side was too large by there; `open` is 1 until v is found to rounding.
struct Secants {
  static constexpr std::size_t most = 64;
  double v[most], before[most], excess[most], open[most];
};

/// Starts at v = free, where the force is `force`; `at_rest` is what holds a place at rest.
SLIPFRONT_CLONES void start_secants(std::size_t size, const double* free, double weight, const double* at_rest,
                                    const double* force, Secants& s) {
  SLIPFRONT_INDEPENDENT
  for (std::size_t i = 0; i < size; ++i) {
    const double slowed = free[i] - weight * force[i];
    const bool held = weight * at_rest[i] >= free[i], found = held || slowed == free[i];
    s.before[i] = free[i];
    s.excess[i] = weight * force[i];
    s.v[i] = held ? 0 : slowed > 0 ? slowed : free[i] / 2;
    s.open[i] = found ? 0.0 : 1.0;
  }
}

/// One step of each from the force at v. The error of a secant is that of its two places multiplied.
SLIPFRONT_CLONES void take_secants(std::size_t size, const double* free, double weight, const double* force,
                                   Secants& s) {
  constexpr double rounding = 4e-16;
  SLIPFRONT_INDEPENDENT
  for (std::size_t i = 0; i < size; ++i) {
    const double v = s.v[i], excess = v + weight * force[i] - free[i];
    const double way = v - s.before[i], next = v - excess * (way / (excess - s.excess[i])), step = next - v;
    const double error = excess > 0 ? excess : -excess, left = step / v * (way / v);
    const bool there = error <= rounding * free[i], inside = next > 0 && next < free[i];
    const bool open = s.open[i] != 0, moves = open && !there && inside;
    s.open[i] = open && !there && !(inside && left <= rounding && left >= -rounding) ? 1.0 : 0.0;
    s.before[i] = v;
    s.excess[i] = excess;
    s.v[i] = moves ? next : v;
  }
}

}  // namespace

const char* name_of(Closure closure) { return closure == Closure::paper ? "paper" : "consistent"; }

Closure closure_named(std::string_view name) {
  for (const Closure c : {Closure::consistent, Closure::paper})
    if (name == name_of(c)) return c;
  throw InputError(
      {.key = "closure", .value = std::string(name), .problem = "unknown", .allowed = "consistent, paper"});
}

/// The root lies in [0, free], as f >= 0. The bracket shrinks by secants; one that moves the same end twice gives the
/// other half its weight (the Illinois rule).
double Law::speed_after(double free, double weight, Memory memory) const {
  const auto excess = [&](double v) { return v + weight * strength(v, memory) - free; };
  double low = 0, high = free, at_low = excess(0), at_high = excess(free);
  if (at_low >= 0) return 0;
  double v = free - at_high;  // a good guess, as the force changes little in a step
  int side = 0;
  for (int i = 0; i < 200 && high - low > 2e-16 * high; ++i) {
    if (!(v > low && v < high)) v = (low + high) / 2;
    const double at_v = excess(v);
    if (std::fabs(at_v) <= 2e-16 * free) break;
    if (at_v > 0) {
      high = v;
      at_high = at_v;
      if (side > 0) at_low /= 2;
      side = 1;
    } else {
      low = v;
      at_low = at_v;
      if (side < 0) at_high /= 2;
      side = -1;
    }
    v = (low * at_high - high * at_low) / (at_high - at_low);
  }
  return v;
}

Parameter coefficient_in(std::string_view unit) {
  return {.name = "coefficient",
          .symbol = "C",
          .unit = unit,
          .dimension = Dimension::force,
          .if_missing = "counts as 0: there is no friction"};
}

Parameter strength_in(std::string_view unit, std::string_view symbol) {
  Parameter strength = coefficient_in(unit);
  strength.name = "strength";
  strength.symbol = symbol;
  strength.if_missing = "counts as 0";
  return strength;
}

const Parameter* Definition::find(std::string_view parameter) const {
  for (const Parameter& p : parameters)
    if (p.name == parameter) return &p;
  return nullptr;
}

double Law::mean_strength(const State& state, double contact, Closure closure, Memory memory) const {
  return mean_of_force(*this, state, contact, closure, memory);
}

std::unique_ptr<RelaxationRate> Law::relaxation_rate(Closure closure) const {
  return std::make_unique<RateByQuadrature>(*this, closure);
}

void RelaxationRate::rates(std::size_t size, const double* fastest, const double* psi, double* rate) const {
  for (std::size_t i = 0; i < size; ++i)
    rate[i] = (*this)({std::asinh(fastest[i] / (2 * std::cosh(psi[i]))), psi[i]}, 1, {});
}

void Law::start(std::span<double>) const {}
void Law::advance(double, double, std::span<double>) const {}
void Law::advance_in_train(double mean, double, double time, std::span<double> memory) const {
  advance(mean, time, memory);  // right for laws that are linear in the velocity
}

void Law::strengths(std::size_t size, const double* speed, Memories memory, double* force) const {
  for (std::size_t i = 0; i < size; ++i) force[i] = strength(speed[i], memory.of(i));
}

void Law::speeds_after(std::size_t size, const double* free, double weight, Memories memory, double* speed) const {
  constexpr int most_steps = 6;
  Secants s;
  double at_rest[Secants::most], force[Secants::most];
  for (std::size_t begin = 0; begin < size; begin += Secants::most) {
    const std::size_t some = std::min(Secants::most, size - begin);
    const Memories theirs = memory.from(begin);
    std::fill_n(s.v, some, 0.0);
    strengths(some, s.v, theirs, at_rest);
    strengths(some, free + begin, theirs, force);
    start_secants(some, free + begin, weight, at_rest, force, s);
    for (int step = 0; step < most_steps && std::find(s.open, s.open + some, 1.0) != s.open + some; ++step) {
      strengths(some, s.v, theirs, force);
      take_secants(some, free + begin, weight, force, s);
    }
    for (std::size_t i = 0; i < some; ++i)
      speed[begin + i] = s.open[i] == 0 ? s.v[i] : speed_after(free[begin + i], weight, theirs.of(i));
  }
}

void Law::speeds_after_under(std::size_t size, const double* share, const double* free, double weight, Memories memory,
                             double* speed) const {
  for (std::size_t i = 0; i < size; ++i) speed[i] = speed_after(free[i], weight * share[i], memory.of(i));
}

void Law::mean_strengths(const Trains& trains, Closure closure, double* mean, double* slope) const {
  if (const auto constant = constant_strength()) {
    std::fill_n(mean, trains.size, *constant);
    if (slope != nullptr) std::fill_n(slope, trains.size, 0.0);
    return;
  }
  constexpr double least_s = 1e-6;  // the mean over length of emptier trains takes many more phases
  double most_empty = 1;
  for (std::size_t i = 0; i < trains.size; ++i) most_empty = std::fmin(most_empty, trains.s[i]);
  if (closure == Closure::consistent || most_empty > least_s) {
    means_by_phase(*this, trains, closure, mean);
  } else {
    for (std::size_t i = 0; i < trains.size; ++i) {
      const double psi = std::atanh(std::fmin(trains.s[i], 1 - 1e-16));
      mean[i] =
          mean_strength({std::asinh(trains.fastest[i] / (2 * std::cosh(psi))), psi}, 1, closure, trains.memory.of(i));
    }
  }
  if (slope == nullptr) return;
  constexpr double step = 1e-6;
  std::vector<double> faster(trains.size);
  for (std::size_t i = 0; i < trains.size; ++i) faster[i] = trains.fastest[i] * std::exp(step);
  mean_strengths({trains.size, faster.data(), trains.s, trains.memory}, closure, slope, nullptr);
  for (std::size_t i = 0; i < trains.size; ++i) slope[i] = (slope[i] - mean[i]) / step;
}

void Law::advance_all(std::size_t size, const double* velocity, double time, std::size_t each, double* memory) const {
  for (std::size_t i = 0; i < size; ++i) advance(velocity[i], time, {memory + i * each, each});
}

void Law::advance_in_trains(std::size_t size, const double* mean, const double* typical, double time, std::size_t each,
                            double* memory) const {
  for (std::size_t i = 0; i < size; ++i) advance_in_train(mean[i], typical[i], time, {memory + i * each, each});
}

}  // namespace slipfront::friction
