#pragma once

#include "slipfront/friction/friction.hpp"

namespace slipfront::pulse {

/// The slip velocity whose logarithm is the mean of ln |w| over slip in a train, a sinh |phi| e^psi (docs/friction.md).
double typical_speed(const State& state, double contact);

/// A train in a contact ratio, of which friction takes momentum while its spacing stays. Momenta are those of one
/// dislocation.
struct SlowedTrain {
  const friction::Friction& friction;
  double spacing;
  double contact;
  friction::Memory memory;  ///< of the places that it lies over
  double psi_guess;         ///< near that of the train
  bool at_rest;             ///< so far; only tells what to try first

  struct Left {
    double momentum, velocity;
    double typical_speed;  ///< a sinh |phi| e^psi, whose logarithm is the mean of ln |w| over slip
  };
  /// What friction leaves of the momentum `free` in a time, implicitly: M + time 2 pi <f>(M) = free. 0 where friction
  /// holds the train. For laws whose force does not fall with the slip velocity at constant memory.
  Left after(double free, double time) const;
};

}  // namespace slipfront::pulse
