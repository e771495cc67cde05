#pragma once

#include <functional>
#include <vector>

#include "pulse/staggered/equations.hpp"
#include "slipfront/train/train.hpp"

namespace slipfront::pulse {

/// What the interface looks like now, for interpolation and sums.
struct View {
  std::vector<double> faces;         ///< x
  std::vector<double> charge_faces;  ///< dislocations left of each face
  std::vector<State> face_states;
  std::vector<double> face_density;  ///< dislocations per unit of x, k / 2 pi, at the faces
  std::vector<double> centres;       ///< x
  std::vector<State> states;  ///< at the centres, in local units where there is a contact profile; empty in a gap
  std::function<double(double)> contact;
  std::vector<double> shocked;                 ///< 1 in the cells near a shock, where values ring; 0 elsewhere
  bool left_free = false, right_free = false;  ///< there is no stress beyond the first or last face
  double period = 0;                           ///< of a ring: x and x + period are one place; 0: none
};

/// The view of these cells now. Without `densities`, which take as long as the rest, face_density is empty.
View view_of(const Problem& problem, const Cells& cells, Equations& equations, bool densities);
/// State at the centre of one cell, as in the view, without making it. There is no contact profile.
State state_in(const Cells& cells, std::size_t cell);

/// State at x between the dislocations of a view; empty outside.
State state_at(const View& view, double x);
/// Averages of a state at x, in the units of the interface whatever the contact there.
train::Averages averages_of(const View& view, const State& state, double x);
/// Number of dislocations left of x.
double charge_left_of(const View& view, double x);

}  // namespace slipfront::pulse
