// Friction that the user draws: a formula of the slip velocity, or a table.

#include <cmath>
#include <memory>
#include <mutex>

#include "friction/laws/tabulated_curve.hpp"
#include "friction/train_means/tabulated_average.hpp"

namespace slipfront::friction {
namespace {

/// Whether the curve leaves rest as a power of w below 0.9.
bool rises_steeply(const Curve& curve) {
  const double near = curve ? curve(1e-10) : 0, far = curve ? curve(1e-8) : 0;
  return near > 0 && std::log(far / near) < 0.9 * std::log(100.0);
}

/// Looks forces up in a table, which is made when it is first needed.
class CurveLoops final : public ForceLoops {
 public:
  using ForceLoops::ForceLoops;
  void strengths(std::size_t size, const double* speed, LocalStates, double* force) const override {
    std::call_once(once_, [this] {
      table_ = std::make_unique<const TabulatedCurve>([this](double w) { return law_.strength(w, {}); });
    });
    table_->values(size, speed, force);
  }

 private:
  mutable std::once_flag once_;
  mutable std::unique_ptr<const TabulatedCurve> table_;
};

class DrawnCurve final : public Law {
 public:
  DrawnCurve(const std::vector<double>& values, const Curve& curve)
      : Law({.steep_at_rest = rises_steeply(curve)}), C_(values[0]), curve_(curve) {}
  double strength(double speed, LocalState) const override { return curve_ ? C_ * curve_(speed) : 0; }
  const ForceLoops& loops() const override { return loops_; }
  const TrainAverage& average() const override { return average_; }

 private:
  double C_;
  Curve curve_;
  CurveLoops loops_{*this};
  TabulatedAverage average_{*this};
};

/// The factor of the curve. 1 leaves the curve as it is.
Parameter factor() {
  Parameter parameter = coefficient_in(force_unit);
  parameter.value = 1;
  parameter.if_missing = {};
  return parameter;
}

}  // namespace

const Definition& formula_law() {
  static const Definition definition{.name = "formula",
                                     .adjective = "drawn",
                                     .equation = "f = C times a formula of w >= 0, with the sign of the slip velocity",
                                     .source = "the scenario",
                                     .parameters = {factor()},
                                     .curve = CurveSource::formula,
                                     .make = make_law<DrawnCurve>};
  return definition;
}

const Definition& table_law() {
  static const Definition definition{
      .name = "table",
      .adjective = "tabulated",
      .equation =
          "f = C times a monotone curve through the points (w, f) of a table, with the sign of the slip velocity",
      .source = "the scenario",
      .parameters = {factor()},
      .curve = CurveSource::table,
      .make = make_law<DrawnCurve>};
  return definition;
}

}  // namespace slipfront::friction
