#pragma once
/// \file
/// Time steps of the averaged solver: half a step of friction, a step of the equations in space by the
/// strong-stability-preserving Runge-Kutta method of third order, and half a step of friction.
/// Also slip, slip velocity, potency and energy of the loops.

#include <array>
#include <cstddef>
#include <vector>

#include "averages/loops/equations.hpp"
#include "averages/loops/loops.hpp"

namespace slipfront::plane {

class LoopSteps {
 public:
  LoopSteps(const Problem& problem, Loops& loops);
  /// Advances by the longest stable step, or by a part of it so that whole steps end at `end`.
  void take(double end);
  /// Finds the equations' results, such as states and velocities, at the present time.
  void look();
  /// The steps in a time, if they are as long as the next one.
  StepsAhead ahead(double duration) const;
  const LoopEquations& equations() const { return equations_; }

 private:
  void add_friction(double time);
  double power_of_friction() const;
  void find_strengths();
  void keep_outside_wall(std::vector<double>& r) const;
  void stage(double t, double step, double of_old, const std::vector<double>& r, const std::vector<double>& momentum);

  const Problem& problem_;
  Loops& loops_;
  LoopEquations equations_;
  std::vector<double> r_rate_, momentum_rate_, r_, momentum_;
  bool friction_acts_ = false;
};

/// Slip velocity in each cell, the rate at which the loops pass.
std::vector<double> slip_velocities(const Loops& loops, const LoopEquations& equations);

/// A direction from the origin. Values between the angles are those of a cubic through the four angles around it.
class Ray {
 public:
  Ray(const Loops& loops, double angle);
  double face(std::size_t row) const { return of(&loops_.r[row * loops_.angles]); }  ///< distance of a face
  /// The value of a cell, of the arrays that have one value for each cell.
  double cell(const std::vector<double>& values, std::size_t row) const { return of(&values[row * loops_.angles]); }
  /// The first face whose distance is smaller than `r`, which must be between those of the first and last faces.
  std::size_t first_face_inside(double r) const;
  /// Number of loops that enclose the point at the distance `r`.
  double loops_outside(double r) const;
  /// The value of the cells at the distance `r`, by straight lines between their centres; 0 where there are no loops.
  double at(const std::vector<double>& values, double r) const;

 private:
  double of(const double* row) const;

  const Loops& loops_;
  std::array<std::size_t, 4> column_{};
  std::array<double, 4> weight_{1, 0, 0, 0};
};

/// Integral over the plane of the slip that the loops have made: 2 pi times the enclosed areas.
double volume(const Loops& loops);

struct LoopEnergy {
  double elastic, kinetic;
};
LoopEnergy energy(const Loops& loops, const LoopEquations& equations);

}  // namespace slipfront::plane
