#pragma once

#include <vector>

#include "pulse/space/cell_states.hpp"
#include "slipfront/friction/friction.hpp"

namespace slipfront::pulse {

/// A train in a contact ratio, of which friction takes momentum while its spacing stays. Momenta are those of one
/// dislocation.
struct SlowedTrain {
  const friction::Friction& friction;
  double spacing;
  double contact;
  friction::LocalState state_values;  ///< of the positions that it covers
  double psi_guess;                   ///< near that of the train

  struct Result {
    double momentum, velocity;
    double typical_speed;  ///< a sinh |phi| e^psi, whose logarithm is the mean of ln |w| over slip (docs/friction.md)
  };
  /// What friction leaves of the momentum `free` in a time, implicitly: M + time 2 pi <f>(M) = free. 0 where friction
  /// holds the train. For laws whose force does not fall with the slip velocity at constant state.
  Result after(double free, double time) const;
};

/// The same for many trains at once, by Newton's method in ln M. Where it fails, or a train is out of the range of the
/// vector code, SlowedTrain has the word.
class SlowedTrains {
 public:
  /// A train is at rest if friction leaves less than this fraction of its frictionless momentum.
  static constexpr double at_rest_below = 1e-12;

  /// Of at most so many trains.
  SlowedTrains(const friction::Friction& friction, std::size_t most);

  struct Train {
    std::size_t cell;  ///< where its results go
    double spacing;    ///< in local units
    double contact;
    const double* state_values;
    double free;     ///< momentum without friction, > 0
    double guess;    ///< of the momentum, > 0
    double s_guess;  ///< of tanh psi
  };
  struct Results {  ///< arrays by cell
    double *momentum, *velocity, *typical_speed;
    double *force, *slope;  ///< mean of f, and what it changes by with ln(momentum)
    double* s;              ///< tanh psi
  };
  /// Friction acts for `time` on the trains given by `add` since the last solve.
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
  void solve(double time, const Results& results);
  /// Forgets what was added: a solve that has thrown leaves the trains that it had not come to.
  void clear() { count_ = 0; }

 private:
  void evaluate();
  void copy(std::size_t from, std::size_t to);
  SlowedTrain::Result solve_alone(std::size_t i, double time) const;

  const friction::Friction& friction_;
  std::size_t variables_;
  // Of the trains that are not yet solved.
  std::size_t count_ = 0;
  CellStates states_;  ///< its spacings are in local units
  std::vector<std::size_t> cell_;
  std::vector<double> contact_, state_values_, free_, momentum_, fastest_, force_, slope_;
  std::vector<double> next_, velocity_, typical_, next_force_, last_;  ///< after a step of Newton's method
};

}  // namespace slipfront::pulse
