#pragma once

#include <functional>
#include <vector>

#include "averages/pulse/grid/layout.hpp"
#include "averages/pulse/staggered/staggered.hpp"
#include "slipfront/theory/train.hpp"

namespace slipfront::pulse {

/// State of the interface at one time, for interpolation and sums.
struct View {
  std::vector<double> faces;         ///< x
  std::vector<double> charge_faces;  ///< dislocations left of each face
  std::vector<State> face_states;
  std::vector<double> face_density;  ///< dislocations per unit of x, k / 2 pi, at the faces
  std::vector<double> centres;       ///< x
  std::vector<State> states;  ///< at the centres, in local units where there is a contact profile; empty in a gap
  std::function<double(double)> contact;
  std::vector<double> shocked;                 ///< 1 in the cells near a shock, where values oscillate; 0 elsewhere
  bool left_free = false, right_free = false;  ///< there is no stress outside the first or last face
  double period = 0;  ///< length of a ring, on which x and x + period are equivalent; 0: no ring
};

/// The view of these cells now. Without `densities`, which cost as much as the rest, face_density is empty.
View view_of(const Problem& problem, const Cells& cells, Equations& equations, bool densities);
/// State at the centre of one cell, as in the view but without the cost of a view. There must be no contact profile.
State state_in(const Cells& cells, std::size_t cell);

/// State at x, interpolated in a view; empty where there are no dislocations.
State state_at(const View& view, double x);
/// Averages of a state at x. They are in the units of the interface, and not in the local units of the contact.
train::Averages averages_of(const View& view, const State& state, double x);
/// Number of dislocations left of x.
double charge_left_of(const View& view, double x);

/// Slip at x since t = 0: 2 pi times the dislocations that have passed it, the integral of the initial stress from
/// where the dislocation now at x began. This is no difference of sums, so that a small slip has small errors.
double slip_at(const InitialGrid& initial, const Cells& cells, const View& view, double x);

}  // namespace slipfront::pulse
