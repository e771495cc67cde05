#include <cmath>

#include "friction/laws/force_of_speed.hpp"
#include "math/simd/elementary.hpp"
#include "slipfront/friction/law.hpp"

namespace slipfront::friction {
namespace {

struct ClosedCoulomb {
  SLIPFRONT_INLINE static double force(double C, double) { return C; }
  SLIPFRONT_INLINE static double slowed(double s, double free) { return at_least(free - s, 0); }
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
  ClosedLoops<ClosedCoulomb> loops_;
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
