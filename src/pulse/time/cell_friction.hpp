#pragma once

#include <cstddef>
#include <vector>

#include "pulse/grid/state_grid.hpp"
#include "pulse/space/semidiscrete.hpp"
#include "pulse/time/ars443.hpp"
#include "pulse/time/friction_solve.hpp"
#include "slipfront/pulse/solver.hpp"

namespace slipfront::pulse {

/// Friction on the cells over a step, from the memory of the places in its middle. Its arrays serve step after step.
class CellFriction {
 public:
  CellFriction(const Problem& problem, std::size_t cells);
  /// Before a step from these cells, whose states `trains` has. Those beyond `awake` rest throughout it.
  void start(const Cells& cells, const CellStates& trains, Stretch awake, const Places& places);

  const std::vector<double>& x() const { return x_; }  ///< centres
  /// What passes over the places that cells of these widths lie over, with the velocities as last found.
  Places::Passing passing(const Cells& cells) const;
  /// From where the cells are in the middle of a step of `dt`.
  void take_memory(const Places& places, double dt);
  /// Ars443::Friction.
  void operator()(const double* y, const double* free, double time, double* momentum, double* velocity);
  /// Mean forces as last found.
  void foretell(std::vector<double>& force) const;
  /// What a step of `time` has got wrong by the memory in its middle from which the forces `foretold` came, beside that
  /// last taken: in units of `scale`, root mean square over some of the cells.
  double memory_error(const std::vector<double>& foretold, double time, const std::vector<double>& scale);
  /// Goes back to the start of the step, for another try.
  void restart();

 private:
  std::size_t variables() const { return problem_.friction.state_size(); }
  double contact(std::size_t cell) const { return problem_.contact ? problem_.contact(x_[cell]) : 1; }
  void find_forces(const std::vector<double>& s, std::size_t stride = 1);

  const Problem& problem_;
  SlowedTrains solve_;
  Stretch awake_{0, 0};
  std::vector<double> charge_, x_, contact_, memory_;
  // Of one dislocation: at the start of the step, and as last found.
  std::vector<double> start_, start_s_, start_typical_, start_momentum_, start_force_, start_slope_;
  std::vector<double> s_, momentum_, velocity_, typical_, force_, slope_;
  std::vector<double> strength_at_rest_, held_;  ///< what holds cells at rest, as a force and as a momentum
  std::vector<double> free_, guess_, moves_, spacing_, middle_;
  std::vector<double> fastest_;  ///< largest slip velocities
  std::vector<std::size_t> slipping_;
  std::vector<double> slipping_fastest_, slipping_s_, slipping_memory_, slipping_force_, slipping_slope_;
};

/// What a step that takes friction cell by cell works with, as long as the cells stay the same.
struct MemoryStep {
  MemoryStep(const Problem& problem, std::size_t cells, std::size_t unknowns)
      : split(cells, unknowns), friction(problem, cells), scale(2 * cells), foretold(cells) {}
  Ars443 split;
  CellFriction friction;
  std::vector<double> before, scale, foretold;
};

}  // namespace slipfront::pulse
