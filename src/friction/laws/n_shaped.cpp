#include "friction/laws/force_of_speed.hpp"

namespace slipfront::friction {
namespace {

struct NShaped {
  using Values = std::array<double, 2>;
  double C, per_velocity;
  explicit NShaped(const Values& values) : C(values[0]), per_velocity(1 / values[1]) {}
  double operator()(double speed) const {
    const double r = speed * per_velocity, q = r < 1e150 ? r : 1e150;
    return C * q / (1 + q * q);
  }
};

}  // namespace

const Definition& n_shaped_law() {
  static const Definition definition{
      .name = "n-shaped",
      .adjective = "n-shaped",
      .equation = "f = C (w / w_p) / (1 + (w / w_p)^2): rises to C / 2 at w_p, and falls as C w_p / w",
      .source = "Brener & Marchenko (2002), J. Exp. Theor. Phys. Lett. 76:211; docs/friction.md",
      .parameters = {coefficient_in(force_unit),
                     velocity_named("velocity", "w_p", "slip velocity of the largest friction")},
      .make = make_law<ForceOfSpeed<NShaped>>};
  return definition;
}

}  // namespace slipfront::friction
