#include "slipfront/friction/law.hpp"

namespace slipfront::friction {
namespace {

class None final : public Law {
 public:
  explicit None(const std::vector<double>&) : Law({.linear_coefficient = 0}) {}
  double strength(double, LocalState) const override { return 0; }
};

}  // namespace

const Definition& no_law() {
  static const Definition definition{
      .name = "none", .adjective = "no", .equation = "f = 0", .source = "", .make = make_law<None>};
  return definition;
}

}  // namespace slipfront::friction
