#pragma once

#include <cstddef>

#include "slipfront/friction/law.hpp"

namespace slipfront::friction {

/// Positions at which to take a law's force for its mean over a train: equal steps of phase from one dislocation to
/// half way to the next. The slip velocity there, over the fastest, is r = dn, which is periodic and smooth in phase,
/// so that the sum converges exponentially, as exp(-2 pi n K' / K) with n steps. dn is found by three descending Landen
/// transformations, each a rational function of the next, the last of which leaves the angle equal to its phase.
class PhaseNodes {
 public:
  static constexpr std::size_t most = 64;  ///< trains at once
  static constexpr double least_s = 1e-12;
  static constexpr std::size_t most_steps = 90;  ///< at least_s
  /// Numbers of steps are rounded up to one of so many. `kind_of` a train of this s = tanh psi returns which it needs.
  /// Trains whose means are found together should be of one kind: then no mean depends on the others.
  static constexpr std::size_t kinds = 15;
  static std::size_t kind_of(double s);
  /// `size` <= most trains of these s = tanh psi; smaller ones count as least_s.
  PhaseNodes(std::size_t size, const double* s);
  std::size_t count() const { return steps_ + 1; }
  /// r of node k < count() in each train, and its weight in the mean over slip or over length.
  void node(std::size_t k, Closure closure, double* r, double* weight) const;

 private:
  std::size_t size_, steps_;
  double squared_sine_[most_steps + 1];              ///< of the angle after the last transformation
  double third_[most], second_[most], first_[most];  ///< coefficients of the three transformations
};

/// Means of the forces that `loops` give, to 1e-10 where they are smooth in ln w.
void means_by_phase(const ForceLoops& loops, const Trains& trains, Closure closure, double* mean);

}  // namespace slipfront::friction
