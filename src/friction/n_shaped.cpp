#include "foundation/simd/vector_code.hpp"
#include "slipfront/friction/friction.hpp"

namespace slipfront::friction {
namespace {

SLIPFRONT_CLONES void forces(double C, double velocity, std::size_t size, const double* speed, double* force) {
  const double per_velocity = 1 / velocity;
  SLIPFRONT_INDEPENDENT
  for (std::size_t i = 0; i < size; ++i) {
    const double r = speed[i] * per_velocity, q = r < 1e150 ? r : 1e150;
    force[i] = C * q / (1 + q * q);
  }
}

class NShaped final : public Law {
 public:
  NShaped(double coefficient, double velocity) : C_(coefficient), v_(velocity) {}
  double strength(double speed, Memory) const override {
    const double r = speed / v_;
    return r < 1 ? C_ * r / (1 + r * r) : C_ / (r + 1 / r);
  }
  void strengths(std::size_t size, const double* speed, Memories, double* force) const override {
    forces(C_, v_, size, speed, force);
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
      .parameters = {coefficient_in(force_unit),
                     {.name = "velocity",
                      .symbol = "w_p",
                      .unit = "c A / pi",
                      .value = 1,
                      .without_least = true,
                      .dimension = Dimension::velocity}},
      .make = [](const std::vector<double>& values, const Curve&) -> std::shared_ptr<const Law> {
        return std::make_shared<NShaped>(values[0], values[1]);
      }};
  return definition;
}

}  // namespace slipfront::friction
