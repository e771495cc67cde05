#pragma once

#include <optional>

#include "foundation/archive.hpp"
#include "pulse/solver.hpp"
#include "slipfront/output/self_check.hpp"

namespace slipfront::pulse {

/// Slip at x = 0, computed in two ways that should agree.
struct SlipTwice {
  double by_place;     ///< from the positions of the dislocations
  double by_velocity;  ///< from the integral of the slip velocity over time
  double sampling;     ///< possible error of the integral due to its sampling in time
  double of_velocity;  ///< possible error of the integral due to errors of the slip velocity
  /// The part of their difference that sampling does not explain. It is at least the part that errors of the slip
  /// velocity may explain.
  double error() const;
};

/// Samples the slip velocity at x = 0 during a run, and integrates it.
class SlipRecord {
 public:
  void sample(const Solver& solver);
  /// A sample of the slip velocity at one time. `doubt` is its possible error.
  void add(double time, double velocity, double doubt);
  /// Empty if x = 0 is outside the domain, or if there are too few samples.
  std::optional<SlipTwice> compare(const Solver& solver) const;
  bool can_compare(const Problem& problem) const;
  /// `slip` and `velocity` are those at x = 0 now.
  SlipTwice compare(double time, double slip, double velocity) const;
  /// Integral of |slip velocity| over time.
  double size() const { return size_; }

  void archive(Archive& a) { a(integral_, size_, doubt_); }

 private:
  output::SampledIntegral integral_;
  double size_ = 0;
  double doubt_ = 0;  ///< integral of the possible error of the slip velocity, estimated in the cell at x = 0
};

}  // namespace slipfront::pulse
