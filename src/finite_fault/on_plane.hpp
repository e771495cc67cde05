#pragma once
/// \file
/// The slip of a finite-fault model as the initial state of a rupture on a plane.

#include <string>
#include <vector>

#include "finite_fault/source/source.hpp"

namespace slipfront::finite_fault {

/// The segment of the hypocentre as a grid, row by row from the lowest row upwards. x is along strike and y up dip, in
/// m from the hypocentre.
struct OnPlane {
  std::vector<double> x, y;  ///< ascending
  double cell_length = 0, cell_width = 0;
  std::vector<double> slip, rupture_time;  ///< slip (m) and rupture time (s) of each cell
  double end = 0;                          ///< s, when the last subfault has slipped
  double moment = 0;                       ///< N m, of this segment
  double largest_slip = 0;                 ///< m
  double largest_gradient = 0;             ///< largest gradient of the slip
  double mean_gradient = 0;                ///< its mean, weighted by slip
  std::string note;                        ///< one sentence if other segments are left out

  std::size_t at(std::size_t i, std::size_t j) const { return j * x.size() + i; }
};
OnPlane on_plane(const FiniteSource& source);

/// The mean slip from which a rupture makes the slip D of the model: U = D_max - D, which is flat where nothing slips.
/// A margin around the model does not slip. Rows of x (m), y (m) and U (m).
std::vector<std::vector<double>> slip_to_come(const OnPlane& fault, double margin);

/// Moment rate of a source on a grid of times that begins at 0, in N m / s.
std::vector<double> moment_rate(const FiniteSource& source, double interval, std::size_t count);

}  // namespace slipfront::finite_fault
