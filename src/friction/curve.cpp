// Friction that the user draws: a formula of the slip velocity, or a table.

#include <cmath>
#include <memory>
#include <mutex>
#include <utility>

#include "friction/mean_table.hpp"
#include "friction/tabulated_curve.hpp"
#include "slipfront/friction/friction.hpp"

namespace slipfront::friction {
namespace {

class DrawnCurve final : public Law {
 public:
  DrawnCurve(double coefficient, Curve curve) : C_(coefficient), curve_(std::move(curve)) {
    // The power of w with which the curve leaves rest.
    const double near = curve_ ? curve_(1e-10) : 0, far = curve_ ? curve_(1e-8) : 0;
    steep_ = near > 0 && std::log(far / near) < 0.9 * std::log(100.0);
  }
  double strength(double speed, Memory) const override { return curve_ ? C_ * curve_(speed) : 0; }
  void strengths(std::size_t size, const double* speed, Memories, double* force) const override {
    std::call_once(once_, [this] {
      table_ = std::make_unique<const TabulatedCurve>([this](double w) { return strength(w, {}); });
    });
    table_->values(size, speed, force);
  }
  void mean_strengths(const Trains& trains, Closure closure, double* mean, double* slope) const override {
    means_.look_up(trains, closure, mean, slope);
  }
  bool steep_at_rest() const override { return steep_; }

 private:
  double C_;
  Curve curve_;
  bool steep_;
  mutable std::once_flag once_;
  mutable std::unique_ptr<const TabulatedCurve> table_;
  MeanTable means_{*this};
};

std::shared_ptr<const Law> drawn(const std::vector<double>& values, const Curve& curve) {
  return std::make_shared<DrawnCurve>(values[0], curve);
}

/// What multiplies the curve: 1 leaves it as it is.
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
                                     .make = drawn};
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
      .make = drawn};
  return definition;
}

}  // namespace slipfront::friction
