#pragma once

#include "friction/train_means/asinh_force.hpp"
#include "slipfront/friction/law.hpp"

namespace slipfront::friction {

/// Averages of f = a asinh(w G) over a train whose positions have the same theta.
class AsinhAverage final : public QuadratureAverage {
 public:
  AsinhAverage(const Law& law, const AsinhForce& force) : QuadratureAverage(law), force_(force) {}
  double mean_strength(const State& train, double contact, Closure closure, LocalState theta) const override;
  void mean_strengths(const Trains& trains, Closure closure, double* mean, double* slope) const override;

 private:
  AsinhForce force_;
};

}  // namespace slipfront::friction
