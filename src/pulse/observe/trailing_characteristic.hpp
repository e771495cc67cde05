#pragma once

#include "pulse/solver.hpp"

namespace slipfront::pulse {

/// The characteristic that left the outermost change of stress at t = 0 on the more stressed side (the left one if
/// both are alike): where the trailing edge of what moves would be without any error, and without friction is.
class TrailingCharacteristic {
 public:
  /// Starts where the initial stress first departs from its value at the stressed end by 1 % of its range: at the
  /// corner of a step.
  explicit TrailingCharacteristic(const Solver& start);
  /// Follows dx/dt = lambda_- (to the left) or lambda_+ (to the right) of the state just ahead of it over one step;
  /// exact where that state is uniform and at rest.
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
  bool steady_ = false;  ///< the state ahead is uniform and stays so: its speed never changes
  double speed_ = 0;     ///< now
};

}  // namespace slipfront::pulse
