#include "slipfront/friction/friction.hpp"

namespace slipfront::friction {
namespace {

class FlashHeating final : public Law {
 public:
  FlashHeating(double at_rest, double weakened, double velocity) : f0_(at_rest), fw_(weakened), v_(velocity) {}
  double strength(double speed, Memory) const override { return fw_ + (f0_ - fw_) / (1 + speed / v_); }

 private:
  double f0_, fw_, v_;
};

}  // namespace

const Definition& flash_heating_law() {
  static const Definition definition{
      .name = "flash-heating",
      .adjective = "flash-heating",
      .equation = "f = f_w + (f_0 - f_w) / (1 + w / w_w), with the sign of w; places stick below f_0",
      .source = "after Rice (2006), J. Geophys. Res. 111:B05311, with a smooth onset",
      .parameters =
          {coefficient_in("mu A^2 / (pi (1 - nu))"),
           {.name = "weakened", .symbol = "f_w", .unit = "mu A^2 / (pi (1 - nu))", .dimension = Dimension::force},
           {.name = "velocity", .symbol = "w_w", .unit = "c A / pi", .value = 1, .without_least = true}},
      .make = [](const std::vector<double>& values, const Curve&) -> std::shared_ptr<const Law> {
        return std::make_shared<FlashHeating>(values[0], values[1], values[2]);
      }};
  return definition;
}

}  // namespace slipfront::friction
