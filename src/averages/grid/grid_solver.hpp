#pragma once
/// \file
/// Values of the averages on a grid, for observers.

#include "averages/grid/steps.hpp"

namespace slipfront::plane {

struct GridEnergy {
  double kinetic, elastic;
};
/// Energies of all lines: the elastic one is that of the same lines at rest.
GridEnergy energy(const GridMotion& motion, const GridEquations& equations, const Cells& cells);

/// A value of the cells at a point, by linear interpolation.
double value_at(const std::vector<double>& values, const Cells& cells, const Point& at);

/// Largest distance of the front from the origin, where y is multiplied by `y_scale`. 0 without a front.
double farthest_front(const std::vector<double>& slip, const Cells& cells, const Walls& walls, double y_scale);

/// The front.
std::vector<Line> front_lines(const std::vector<double>& slip, const Cells& cells);

}  // namespace slipfront::plane
