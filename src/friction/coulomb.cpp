#include <cmath>

#include "slipfront/friction/friction.hpp"

namespace slipfront::friction {
namespace {

class Coulomb final : public Law {
 public:
  explicit Coulomb(double coefficient) : C_(coefficient) {}
  double strength(double, Memory) const override { return C_; }
  std::optional<double> constant_strength() const override { return C_; }
  double speed_after(double free, double weight, Memory) const override { return std::fmax(free - weight * C_, 0); }
  double mean_strength(const State&, double, Closure, Memory) const override { return C_; }

 private:
  double C_;
};

}  // namespace

const Definition& coulomb_law() {
  static const Definition definition{
      .name = "coulomb",
      .adjective = "coulomb",
      .equation = "f = C sign(w); places stick while the force on them is smaller",
      .source = "Coulomb (1785)",
      .parameters = {coefficient_in(force_unit)},
      .make = [](const std::vector<double>& values, const Curve&) -> std::shared_ptr<const Law> {
        return std::make_shared<Coulomb>(values[0]);
      }};
  return definition;
}

Friction coulomb(double coefficient, Closure closure) { return {coulomb_law(), {coefficient}, closure}; }

}  // namespace slipfront::friction
