#include <cmath>
#include <numbers>

#include "friction/laws/force_of_speed.hpp"
#include "math/simd/elementary.hpp"
#include "slipfront/friction/law.hpp"
#include "slipfront/math/elliptic.hpp"
#include "slipfront/theory/train.hpp"

namespace slipfront::friction {
namespace {

using std::numbers::pi;

/// loss / P: C, or C W / I, which is C pi^2 / (4 E K).
class ViscousRate final : public RelaxationRate {
 public:
  ViscousRate(double coefficient, Closure closure) : C_(coefficient), closure_(closure) {}
  double operator()(const State& train, double, LocalState) const override {
    if (C_ == 0 || train.empty()) return 0;
    if (closure_ == Closure::consistent) return C_;
    const elliptic::AtPsi at = elliptic::at_psi(train.psi);
    return C_ * pi * pi / (4 * at.E * at.K);
  }
  bool tabulated() const override { return true; }

 private:
  double C_;
  Closure closure_;
};

class ViscousAverage final : public QuadratureAverage {
 public:
  ViscousAverage(const Law& law, double coefficient) : QuadratureAverage(law), C_(coefficient) {}
  /// <w sigma> / k or <w>.
  double mean_strength(const State& train, double contact, Closure closure, LocalState) const override {
    const train::Averages a = train::averages(train);
    return C_ * contact * std::fabs(closure == Closure::consistent ? a.I : a.W);
  }
  std::unique_ptr<RelaxationRate> relaxation_rate(Closure closure) const override {
    return std::make_unique<ViscousRate>(C_, closure);
  }

 private:
  double C_;
};

struct ClosedViscous {
  SLIPFRONT_INLINE static double force(double C, double speed) { return C * speed; }
  SLIPFRONT_INLINE static double left(double s, double) { return 1 / (1 + s); }
};

class Viscous final : public Law {
 public:
  explicit Viscous(const std::vector<double>& v)
      : Law({.linear_coefficient = v[0]}), C_(v[0]), loops_(*this, C_), average_(*this, C_) {}
  double strength(double speed, LocalState) const override { return C_ * speed; }
  double speed_after(double free, double weight, LocalState) const override { return free / (1 + weight * C_); }
  const ForceLoops& loops() const override { return loops_; }
  const TrainAverage& average() const override { return average_; }

 private:
  double C_;
  ClosedLoops<ClosedViscous> loops_;
  ViscousAverage average_;
};

}  // namespace

const Definition& viscous_law() {
  static const Definition definition{.name = "viscous",
                                     .adjective = "viscous",
                                     .equation = "f = C w",
                                     .source = "Gershenzon, Bambakidis & Skinner (2015), Eqs. (7)",
                                     .parameters = {coefficient_in("mu A^2 / (pi (1 - nu)) over the unit of w")},
                                     .make = make_law<Viscous>};
  return definition;
}

}  // namespace slipfront::friction
