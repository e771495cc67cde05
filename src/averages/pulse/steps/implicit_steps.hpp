#pragma once

#include <vector>

#include "averages/pulse/staggered/staggered.hpp"
#include "averages/pulse/steps/step_scales.hpp"
#include "averages/pulse/time/integrators.hpp"
#include "math/time_steps.hpp"

namespace slipfront::pulse {

/// Steps of the staggered equations where friction rules, in which waves cross many cells.
class ImplicitSteps {
 public:
  ImplicitSteps(const Problem& problem, const StepScales& measures, const Staggered& staggered);
  /// Takes one step of at most `remaining` and returns its length. `crossing` is the time in which a wave crosses a
  /// cell. \throws NumericsError where no step is short enough.
  double take(Cells& cells, Equations& equations, double remaining, double crossing);
  /// Rate at which friction takes the momentum that it allows where all is at rest, from the largest force.
  double friction_rate_from_rest(const Cells& cells, Staggered& staggered);

 private:
  void find_scale(const Cells& cells, Equations& equations, double crossing);
  double take_by_linearisation(Cells& cells, Equations& equations, double remaining, double crossing);
  /// Serves friction so steep at rest that its slope does not show its force at the end of a step.
  double take_by_faces(Cells& cells, Staggered& staggered, double longest);
  StepAttempt attempt_by_faces(const Cells& cells, Staggered& staggered, double dt);

  const Problem& problem_;
  const StepScales& measures_;
  Rodas4 rodas_;
  ExtrapolatedEuler euler_;
  std::vector<double> unknowns_, rate_, next_, scale_, cell_scale_;
};

}  // namespace slipfront::pulse
