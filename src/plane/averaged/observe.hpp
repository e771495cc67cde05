#pragma once
/// \file
/// Slip, slip velocity, potency and energy of the loops.

#include "plane/averaged/equations.hpp"
#include "plane/averaged/loops.hpp"

namespace slipfront::plane {

/// Slip velocity in each cell, the rate at which the loops pass.
std::vector<double> slip_velocities(const Loops& loops, const LoopEquations& equations);

/// Distances of all faces in one direction, from the outermost to the innermost.
std::vector<double> distances(const Loops& loops, double angle);

/// Values of a cell array in one direction, by interpolation of third order between the angles.
std::vector<double> along_ray(const Loops& loops, const std::vector<double>& cells, double angle);

/// Number of loops that enclose the point at the distance `r` on a ray with these distances of the faces.
double loops_outside(const Loops& loops, const std::vector<double>& faces, double r);

/// Integral over the plane of the slip that the loops have made: 2 pi times the enclosed areas.
double volume(const Loops& loops);

struct LoopEnergy {
  double elastic, kinetic;
};
LoopEnergy energy(const Loops& loops, const LoopEquations& equations);

}  // namespace slipfront::plane
