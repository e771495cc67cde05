#pragma once
/// \file
/// Time steps of the averaged solver: half a step of friction, a step of the equations in space by the
/// strong-stability-preserving Runge-Kutta method of third order, and half a step of friction.

#include <vector>

#include "plane/averaged/equations.hpp"
#include "plane/averaged/loops.hpp"

namespace slipfront::plane {

class LoopSteps {
 public:
  LoopSteps(const Problem& problem, Loops& loops);
  /// Advances by the longest stable step, or by a part of it so that whole steps end at `end`.
  void take(double end);
  /// Finds the equations' results, such as states and velocities, at the present time.
  void look();
  /// The steps in a time, if they are as long as the next one.
  StepsAhead ahead(double duration) const;
  const LoopEquations& equations() const { return equations_; }

 private:
  void add_friction(double time);
  double power_of_friction() const;
  void find_strengths();
  void keep_outside_wall(std::vector<double>& r) const;
  void stage(double t, double step, double of_old, const std::vector<double>& r, const std::vector<double>& momentum);

  const Problem& problem_;
  Loops& loops_;
  LoopEquations equations_;
  std::vector<double> r_rate_, momentum_rate_, r_, momentum_;
  bool friction_acts_ = false;
};

}  // namespace slipfront::plane
