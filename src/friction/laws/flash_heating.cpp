#include "friction/laws/force_of_speed.hpp"

namespace slipfront::friction {
namespace {

struct FlashHeating {
  using Values = std::array<double, 3>;
  double weakened, gain, per_velocity;
  explicit FlashHeating(const Values& v) : weakened(v[1]), gain(v[0] - v[1]), per_velocity(1 / v[2]) {}
  double operator()(double speed) const { return weakened + gain / (1 + speed * per_velocity); }
};

}  // namespace

const Definition& flash_heating_law() {
  static const Definition definition{
      .name = "flash-heating",
      .adjective = "flash-heating",
      .equation = "f = f_w + (f_0 - f_w) / (1 + w / w_w), with the sign of w; positions stick below f_0",
      .source = "after Rice (2006), J. Geophys. Res. 111:B05311, with a smooth onset",
      .parameters = {strength_in(force_unit, "f_0", "friction at rest"),
                     force_named("weakened", "f_w", "friction of fast slip"),
                     velocity_named("velocity", "w_w", "slip velocity that halves the excess of friction over f_w")},
      .make = make_law<ForceOfSpeed<FlashHeating>>};
  return definition;
}

}  // namespace slipfront::friction
