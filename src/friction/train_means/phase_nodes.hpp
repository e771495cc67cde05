#pragma once

#include <cstddef>

#include "slipfront/friction/law.hpp"

namespace slipfront::friction {

/// Positions at which a law's force is evaluated for its mean over a train. They are equal steps of phase from one
/// dislocation to half way to the next. The slip velocity at a node, over the fastest, is r = dn, which is periodic and
/// smooth in phase. The sum over n steps therefore converges exponentially, as exp(-2 pi n K' / K). Three descending
/// Landen transformations give dn. Each is a rational function of the next, and after the last the angle equals its
/// phase.
class PhaseNodes {
 public:
  static constexpr std::size_t most = 64;  ///< trains at once
  static constexpr double least_s = 1e-12;
  static constexpr std::size_t most_steps = 90;  ///< needed at s = least_s
  /// The number of steps is rounded up to one of this many values, or kinds. `kind_of` returns the kind that a train
  /// with this s = tanh psi needs. Trains whose means are computed together should be of one kind; then no mean depends
  /// on the other trains.
  static constexpr std::size_t kinds = 15;
  static std::size_t kind_of(double s);
  /// Nodes for `size` <= `most` trains with these s = tanh psi. Values below least_s count as least_s.
  PhaseNodes(std::size_t size, const double* s);
  std::size_t count() const { return steps_ + 1; }
  /// Computes r at node k < count() in each train, and the weight of the node in the mean over slip or over length.
  void node(std::size_t k, Closure closure, double* r, double* weight) const;

 private:
  std::size_t size_, steps_;
  double squared_sine_[most_steps + 1];              ///< sin^2 of the angle after the last transformation
  double third_[most], second_[most], first_[most];  ///< coefficients of the three transformations
};

/// Computes the means of the forces that `loops` returns, to 1e-10 if the forces are smooth in ln w.
void means_by_phase(const ForceLoops& loops, const Trains& trains, Closure closure, double* mean);

}  // namespace slipfront::friction
