#include "foundation/simd/vector_code.hpp"
#include "slipfront/friction/friction.hpp"

namespace slipfront::friction {
namespace {

SLIPFRONT_CLONES void forces(double weakened, double gain, double velocity, std::size_t size, const double* speed,
                             double* force) {
  const double per_velocity = 1 / velocity;
  SLIPFRONT_INDEPENDENT
  for (std::size_t i = 0; i < size; ++i) force[i] = weakened + gain / (1 + speed[i] * per_velocity);
}

class FlashHeating final : public Law {
 public:
  FlashHeating(double at_rest, double weakened, double velocity) : f0_(at_rest), fw_(weakened), v_(velocity) {}
  double strength(double speed, Memory) const override { return fw_ + (f0_ - fw_) / (1 + speed / v_); }
  void strengths(std::size_t size, const double* speed, Memories, double* force) const override {
    forces(fw_, f0_ - fw_, v_, size, speed, force);
  }

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
      .parameters = {strength_in(force_unit, "f_0"),
                     {.name = "weakened", .symbol = "f_w", .unit = force_unit, .dimension = Dimension::force},
                     {.name = "velocity",
                      .symbol = "w_w",
                      .unit = "c A / pi",
                      .value = 1,
                      .without_least = true,
                      .dimension = Dimension::velocity}},
      .make = [](const std::vector<double>& values, const Curve&) -> std::shared_ptr<const Law> {
        return std::make_shared<FlashHeating>(values[0], values[1], values[2]);
      }};
  return definition;
}

}  // namespace slipfront::friction
