#pragma once
/// \file
/// Slip, slip velocity, potency and energy of the loops.

#include "plane/averaged/equations.hpp"
#include "plane/averaged/loops.hpp"

namespace slipfront::plane {

/// Slip velocity in each cell, the rate at which the loops pass.
std::vector<double> slip_velocities(const Loops& loops, const LoopEquations& equations);

/// The values of all faces or cells in one direction, from the outermost to the innermost, by a cubic between the
/// angles. The values of `loops.r` are the distances of the faces.
std::vector<double> along_ray(const Loops& loops, const std::vector<double>& values, double angle);

/// Number of loops that enclose the point at the distance `r` on a ray with these distances of the faces.
double loops_outside(const Loops& loops, const std::vector<double>& faces, double r);

/// Integral over the plane of the slip that the loops have made: 2 pi times the enclosed areas.
double volume(const Loops& loops);

struct LoopEnergy {
  double elastic, kinetic;
};
LoopEnergy energy(const Loops& loops, const LoopEquations& equations);

}  // namespace slipfront::plane
