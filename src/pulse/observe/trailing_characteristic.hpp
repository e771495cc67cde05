#pragma once

#include "pulse/solver.hpp"

namespace slipfront::pulse {

/// The characteristic that leaves the outermost change of stress at t = 0 on the more stressed side (the left one if
/// both are equal). Without numerical errors, the trailing edge of the motion would follow it, and without friction it
/// does.
class TrailingCharacteristic {
 public:
  /// Starts where the initial stress first departs from its value at the stressed end by 1 % of its range. For a step
  /// of stress, this is the corner.
  explicit TrailingCharacteristic(const Solver& start);
  /// Follows dx/dt = lambda_- (to the left) or lambda_+ (to the right) over one step, with the state just ahead. It is
  /// exact if that state is uniform and at rest.
  void advance(const Solver& now, double dt);
  double position() const { return position_; }
  bool stressed_left() const { return stressed_left_; }
  /// Continues from a saved position; `now` is the solver as it was then.
  void restore(const Solver& now, double position);

 private:
  double speed_into(const State& ahead) const;
  double speed_at(const Solver& now) const;

  double position_;
  bool stressed_left_;
  bool steady_ = false;  ///< the state ahead stays uniform, so the speed is constant
  double speed_ = 0;     ///< present speed
};

}  // namespace slipfront::pulse
