// What holds for any law: averages by quadrature, the implicit solve by bracketing.

#include "slipfront/friction/law.hpp"

#include <cmath>
#include <numbers>
#include <string>

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

void Law::start(std::span<double>) const {}
void Law::advance(double, double, std::span<double>) const {}
void Law::advance_in_train(double mean, double, double time, std::span<double> memory) const {
  advance(mean, time, memory);  // right for laws that are linear in the velocity
}

}  // namespace slipfront::friction
