#include "slipfront/friction/law.hpp"

namespace slipfront::friction {
namespace {

class None final : public Law {
 public:
  double strength(double, Memory) const override { return 0; }
  std::optional<double> linear_coefficient() const override { return 0; }
  double mean_strength(const State&, double, Closure, Memory) const override { return 0; }
};

}  // namespace

const Definition& no_law() {
  static const Definition definition{
      .name = "none",
      .adjective = "no",
      .equation = "f = 0",
      .source = "",
      .make = [](const std::vector<double>&, const Curve&) -> std::shared_ptr<const Law> {
        return std::make_shared<None>();
      }};
  return definition;
}

}  // namespace slipfront::friction
