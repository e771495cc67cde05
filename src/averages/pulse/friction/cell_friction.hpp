#pragma once

#include <cstddef>
#include <vector>

#include "averages/pulse/grid/cells.hpp"
#include "averages/pulse/space/cell_states.hpp"
#include "slipfront/averages/pulse/problem.hpp"
#include "slipfront/friction/friction.hpp"

namespace slipfront::pulse {

/// A train at a given contact ratio. Friction takes momentum from it while its spacing is constant. Momenta are per
/// dislocation.
struct SlowedTrain {
  const friction::Friction& friction;
  double spacing;
  double contact;
  friction::LocalState state_values;  ///< state variables at the positions that the train covers
  double psi_guess;                   ///< initial guess of psi

  struct Result {
    double momentum, velocity;
    double typical_speed;  ///< a sinh |phi| e^psi, whose logarithm is the mean of ln |w| over slip (docs/friction.md)
  };
  /// Returns the train after friction has acted for `time` on the momentum `free`. The momentum M solves the implicit
  /// equation M + time 2 pi <f>(M) = free, and is 0 if friction holds the train. The law's force must not fall with the
  /// slip velocity at constant state.
  Result after(double free, double time) const;
};

/// Solves the equation of SlowedTrain for many trains at once, by Newton's method in ln M. If the method fails, or if a
/// train is outside the range of the vector code, SlowedTrain solves it.
class SlowedTrains {
 public:
  /// A train is at rest if friction leaves less than this fraction of its frictionless momentum.
  static constexpr double at_rest_below = 1e-12;

  /// Reserves space for `most` trains.
  SlowedTrains(const friction::Friction& friction, std::size_t most);

  struct Train {
    std::size_t cell;  ///< index at which its results are stored
    double spacing;    ///< in local units
    double contact;
    const double* state_values;
    double free;     ///< momentum without friction, > 0
    double guess;    ///< initial guess of the momentum, > 0
    double s_guess;  ///< initial guess of tanh psi
  };
  struct Results {  ///< arrays by cell
    double *momentum, *velocity, *typical_speed;
    double *force, *slope;  ///< mean of f, and its derivative with respect to ln(momentum)
    double* s;              ///< tanh psi
  };
  /// Adds a train to those that the next `solve` treats.
  void add(const Train& train) {
    const std::size_t i = count_++;
    cell_[i] = train.cell;
    contact_[i] = train.contact;
    free_[i] = train.free;
    momentum_[i] = train.guess;
    states_.spacing[i] = train.spacing;
    states_.s[i] = train.s_guess;
    for (std::size_t v = 0; v < variables_; ++v) state_values_[i * variables_ + v] = train.state_values[v];
  }
  /// Lets friction act for `time` on all added trains, and removes them.
  void solve(double time, const Results& results);
  /// Removes all added trains. After an exception, `solve` leaves those that it has not solved.
  void clear() { count_ = 0; }

 private:
  void evaluate();
  void copy(std::size_t from, std::size_t to);
  SlowedTrain::Result solve_alone(std::size_t i, double time) const;

  const friction::Friction& friction_;
  std::size_t variables_;
  // Values of the trains that are not solved yet.
  std::size_t count_ = 0;
  CellStates states_;  ///< its spacings are in local units
  std::vector<std::size_t> cell_;
  std::vector<double> contact_, state_values_, free_, momentum_, fastest_, force_, slope_;
  std::vector<double> next_, velocity_, typical_, next_force_, last_;  ///< values after one Newton step
};

/// Computes friction on the cells over one step, with the state variables in the middle of the step. The arrays are
/// reused from step to step.
class CellFriction {
 public:
  CellFriction(const Problem& problem, std::size_t cells);
  /// Prepares a step from these cells, whose trains have the states `trains`. Cells outside `awake` are at rest
  /// throughout the step.
  void start(const Cells& cells, const CellStates& trains, CellRange awake, const StateGrid& grid);

  const std::vector<double>& x() const { return x_; }  ///< centres
  /// Finds the slip velocities at the centres of `cells` from the velocities of the last call.
  void find_passing(const Cells& cells, StateGrid::Passing& passing) const;
  /// Looks up the state variables where the cell centres are in the middle of a step of length `dt`.
  void take_state(const StateGrid& grid, const std::vector<double>& values, double dt);
  /// Has the signature of Ars443::Friction.
  void operator()(const double* y, const double* free, double time, double* momentum, double* velocity);
  /// Mean friction forces from the last call.
  const std::vector<double>& forces() const { return force_; }
  /// Length of a step in friction times, for each cell, by the last call: its length times the slope of friction.
  const std::vector<double>& friction_times(double time);
  /// Error of a step of length `time` that used the forces `forces_before`, if the state variables last looked up are
  /// right. It is the root mean square over a sample of the cells, in units of `scale`.
  double state_error(const std::vector<double>& forces_before, double time, const std::vector<double>& scale);
  /// Returns to the start of the step, for another attempt.
  void restart();

 private:
  std::size_t variables() const { return problem_.friction.state_size(); }
  double contact(std::size_t cell) const { return problem_.contact ? problem_.contact(x_[cell]) : 1; }
  void find_forces(const std::vector<double>& s, std::size_t stride = 1);

  const Problem& problem_;
  SlowedTrains solve_;
  CellRange awake_{0, 0};
  std::vector<double> charge_, x_, contact_, state_;
  // Values per dislocation, at the start of the step and from the last call.
  std::vector<double> start_, start_s_, start_typical_, start_momentum_, start_force_, start_slope_;
  std::vector<double> s_, momentum_, velocity_, typical_, force_, slope_;
  std::vector<double> strength_at_rest_, held_;  ///< friction strength at rest, as a force and as a momentum
  std::vector<double> free_, guess_, moves_, spacing_, middle_;
  std::vector<double> fastest_;  ///< largest slip velocity in each cell
  std::vector<double> friction_times_;
  std::vector<std::size_t> slipping_;
  std::vector<double> slipping_fastest_, slipping_s_, slipping_state_, slipping_force_, slipping_slope_;
};

}  // namespace slipfront::pulse
