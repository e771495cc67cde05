#include <algorithm>
#include <cmath>

#include "math/simd/elementary.hpp"
#include "math/simd/vector_code.hpp"
#include "slipfront/friction/law.hpp"

namespace slipfront::friction {
namespace {

SLIPFRONT_CLONES void slow(double most, std::size_t size, const double* share, const double* free, double* speed) {
  SLIPFRONT_INDEPENDENT
  for (std::size_t i = 0; i < size; ++i) speed[i] = at_least(free[i] - (share == nullptr ? most : most * share[i]), 0);
}

class CoulombLoops final : public ForceLoops {
 public:
  CoulombLoops(const Law& law, double coefficient) : ForceLoops(law), C_(coefficient) {}
  void strengths(std::size_t size, const double*, LocalStates, double* force) const override {
    std::fill_n(force, size, C_);
  }
  void speeds_after(std::size_t size, const double* free, double weight, LocalStates, double* speed) const override {
    slow(weight * C_, size, nullptr, free, speed);
  }
  void speeds_after_under(std::size_t size, const double* share, const double* free, double weight, LocalStates,
                          double* speed) const override {
    slow(weight * C_, size, share, free, speed);
  }

 private:
  double C_;
};

class Coulomb final : public Law {
 public:
  explicit Coulomb(const std::vector<double>& values)
      : Law({.constant_strength = values[0]}), C_(values[0]), loops_(*this, C_) {}
  double strength(double, LocalState) const override { return C_; }
  double speed_after(double free, double weight, LocalState) const override { return std::fmax(free - weight * C_, 0); }
  const ForceLoops& loops() const override { return loops_; }

 private:
  double C_;
  CoulombLoops loops_;
};

}  // namespace

const Definition& coulomb_law() {
  static const Definition definition{.name = "coulomb",
                                     .adjective = "coulomb",
                                     .equation = "f = C sign(w); positions stick while the force on them is smaller",
                                     .source = "Coulomb (1785)",
                                     .parameters = {coefficient_in(force_unit)},
                                     .make = make_law<Coulomb>};
  return definition;
}

}  // namespace slipfront::friction
