#pragma once

#include <vector>

#include "foundation/math/step_control.hpp"
#include "pulse/steps/measures.hpp"
#include "pulse/time/ssprk54.hpp"

namespace slipfront::pulse {

/// Explicit steps, as long as waves and friction allow.
class ExplicitSteps {
 public:
  ExplicitSteps(const Problem& problem, const Measures& measures, std::size_t cells);
  /// Takes one step of at most `remaining` and returns its length. `rate` are the rates at the present time, `crossing`
  /// is the time in which a wave crosses a cell. \throws NumericsError if no step is short enough.
  double take(Cells& cells, Semidiscrete& equations, const std::vector<double>& rate, double remaining,
              double crossing);

 private:
  StepAttempt attempt(Cells& cells, Semidiscrete& equations, const std::vector<double>& rate, double dt);

  const Problem& problem_;
  const Measures& measures_;
  Ssprk54 step_;
  std::vector<double> before_, scale_;
};

}  // namespace slipfront::pulse
