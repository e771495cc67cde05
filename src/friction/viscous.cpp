#include <cmath>
#include <numbers>

#include "slipfront/elliptic/complete.hpp"
#include "slipfront/friction/friction.hpp"
#include "slipfront/train/train.hpp"

namespace slipfront::friction {
namespace {

using std::numbers::pi;

/// loss / P: C, or C W / I, which is C pi^2 / (4 E K).
class ViscousRate final : public RelaxationRate {
 public:
  ViscousRate(double coefficient, Closure closure) : C_(coefficient), closure_(closure) {}
  double operator()(const State& state, double, Memory) const override {
    if (C_ == 0 || state.empty()) return 0;
    if (closure_ == Closure::consistent) return C_;
    const elliptic::AtPsi at = elliptic::at_psi(state.psi);
    return C_ * pi * pi / (4 * at.E * at.K);
  }

 private:
  double C_;
  Closure closure_;
};

class Viscous final : public Law {
 public:
  explicit Viscous(double coefficient) : C_(coefficient) {}
  double strength(double speed, Memory) const override { return C_ * speed; }
  std::optional<double> linear_coefficient() const override { return C_; }
  double speed_after(double free, double weight, Memory) const override { return free / (1 + weight * C_); }
  /// <w sigma> / k or <w>.
  double mean_strength(const State& state, double contact, Closure closure, Memory) const override {
    const train::Averages a = train::averages(state);
    return C_ * contact * std::fabs(closure == Closure::consistent ? a.I : a.W);
  }
  std::unique_ptr<RelaxationRate> relaxation_rate(Closure closure) const override {
    return std::make_unique<ViscousRate>(C_, closure);
  }

 private:
  double C_;
};

}  // namespace

const Definition& viscous_law() {
  static const Definition definition{
      .name = "viscous",
      .adjective = "viscous",
      .equation = "f = C w",
      .source = "Gershenzon, Bambakidis & Skinner (2015), Eqs. (7)",
      .parameters = {coefficient_in("mu A^2 / (pi (1 - nu)) over the unit of w")},
      .make = [](const std::vector<double>& values, const Curve&) -> std::shared_ptr<const Law> {
        return std::make_shared<Viscous>(values[0]);
      }};
  return definition;
}

Friction viscous(double coefficient, Closure closure) { return {viscous_law(), {coefficient}, closure}; }

}  // namespace slipfront::friction
