#include "slipfront/friction/friction.hpp"

namespace slipfront::friction {
namespace {

class NShaped final : public Law {
 public:
  NShaped(double coefficient, double velocity) : C_(coefficient), v_(velocity) {}
  double strength(double speed, Memory) const override {
    const double r = speed / v_;
    return r < 1 ? C_ * r / (1 + r * r) : C_ / (r + 1 / r);
  }

 private:
  double C_, v_;
};

}  // namespace

const Definition& n_shaped_law() {
  static const Definition definition{
      .name = "n-shaped",
      .adjective = "n-shaped",
      .equation = "f = C (w / w_p) / (1 + (w / w_p)^2): rises to C / 2 at w_p, and falls as C w_p / w",
      .source = "Brener & Marchenko (2002), J. Exp. Theor. Phys. Lett. 76:211; docs/friction.md",
      .parameters = {coefficient_in("mu A^2 / (pi (1 - nu))"),
                     {.name = "velocity", .symbol = "w_p", .unit = "c A / pi", .value = 1, .without_least = true}},
      .make = [](const std::vector<double>& values, const Curve&) -> std::shared_ptr<const Law> {
        return std::make_shared<NShaped>(values[0], values[1]);
      }};
  return definition;
}

}  // namespace slipfront::friction
