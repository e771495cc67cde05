#pragma once
/// \file
/// The initial conditions, forces and numerical settings of a pulse (docs/pulse.md).

#include <cmath>
#include <functional>

#include "slipfront/friction/friction.hpp"

namespace slipfront::pulse {

/// What an end of the domain does where the stress reaches it.
enum class End {
  continued,  ///< the train goes on beyond, as it is at the end: dislocations come in and leave
  fixed,      ///< nothing passes
  free,       ///< no stress: dislocations leave, none comes in
};

/// What to solve.
struct Problem {
  std::function<double(double)> stress;               ///< initial stress at x, >= 0; the interface is at rest
  std::function<double(double x, double t)> forcing;  ///< F; null: none
  std::function<double(double)> contact = {};         ///< relative contact ratio a(x) > 0; null: 1
  friction::Friction friction;
  double left = -1, right = 1;  ///< domain at t = 0
  double corner = 0;            ///< x of a step of stress: a face is laid there
  End left_end = End::continued, right_end = End::continued;
  bool periodic = false;             ///< a ring of the domain's length, stressed at both ends, which then do not count
  int cells = 400;                   ///< over the parts of the domain that are not empty, >= 4
  double tolerance = 1e-6;           ///< relative, of the implicit steps
  double explicit_tolerance = 1e-4;  ///< of the explicit steps, which the size of the cells mostly sets
  double longest_step = HUGE_VAL;    ///< a forcing may change while waves hardly move
  double cfl = 1.0;                  ///< of the explicit steps; smooth problems bear 1.4, steps of stress do not
};

}  // namespace slipfront::pulse
