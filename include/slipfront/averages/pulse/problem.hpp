#pragma once
/// \file
/// The initial conditions, forces and numerical settings of a pulse (docs/pulse.md).

#include <cmath>
#include <functional>

#include "slipfront/friction/friction.hpp"

namespace slipfront::pulse {

/// Boundary condition at an end of the domain. It matters as soon as the stress reaches the end.
enum class End {
  continued,  ///< the train at the end continues outside the domain: dislocations enter and leave
  fixed,      ///< a wall that no dislocation passes
  free,       ///< no stress outside: dislocations leave, none enters
};

/// The initial value problem and the numerical settings of a pulse run.
struct Problem {
  std::function<double(double)> stress;               ///< initial stress at x, >= 0; the interface is at rest at t = 0
  std::function<double(double x, double t)> forcing;  ///< F; null: none
  std::function<double(double)> contact = {};         ///< relative contact ratio a(x) > 0; null: 1
  friction::Friction friction;
  double left = -1, right = 1;  ///< domain at t = 0
  double corner = 0;            ///< x of a step of stress, where a cell face is placed; HUGE_VAL: smooth stress
  End left_end = End::continued, right_end = End::continued;
  bool periodic = false;    ///< the domain is a ring, stressed at both ends; left_end and right_end are then ignored
  int cells = 400;          ///< number of cells, >= 4, shared among the stressed parts of the domain
  double tolerance = 1e-6;  ///< relative tolerance of the implicit steps
  double explicit_tolerance = 1e-4;  ///< relative tolerance of the explicit steps; mostly the cell size limits them
  double longest_step = HUGE_VAL;    ///< longest time step: a forcing may change while waves hardly move
  bool many_trains = false;          ///< any number of trains at one position, under viscous friction up to two
  double cfl = 1.0;  ///< Courant number of the explicit steps: smooth problems tolerate 1.4, steps of stress do not
};

}  // namespace slipfront::pulse
