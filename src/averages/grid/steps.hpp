#pragma once
/// \file
/// Time steps of the averaged solver on a grid: half a step of friction, a step of the equations in space by the
/// strong-stability-preserving Runge-Kutta method of third order, and half a step of friction. Friction with strength
/// at rest acts after each stage instead, so that it holds what it can hold, and so does friction that rises steeply
/// from rest, by an implicit step.
///
/// The rupture front on a grid: the contour U = 0. Outside it the slip continues with negative values, so that the
/// front moves as its lines do.

#include <memory>
#include <optional>
#include <vector>

#include "averages/grid/equations.hpp"
#include "averages/pulse/friction/cell_friction.hpp"

namespace slipfront::plane {

/// Gradient of the slip just outside the front, in the frame of the lines. The pressure of such lines is 0.004, and so
/// nearly that of the outermost one, which is 0. A smaller value makes the front too fast on coarse grids.
inline constexpr double gradient_ahead = 0.7;

class Front {
 public:
  Front(const Problem& problem, const Cells& cells);
  /// Continues slip and action over the front by some cells, and sets both to 0 farther out. Returns the cells in which
  /// they are known.
  const std::vector<char>& extend(Averages& now);

 private:
  struct Neighbours;
  Neighbours neighbours_of(std::size_t cell, const Averages& now) const;
  void set_first(std::size_t cell, const Neighbours& n, Averages& now) const;

  const Problem& problem_;
  const Cells& cells_;
  double psi_ahead_, J0_ahead_;
  std::vector<char> known_;
  std::vector<std::size_t> empty_, found_;
};

/// The state of a run, from which it continues to the same bits.
struct GridMotion {
  double time = 0;
  long steps = 0;
  Averages now;
  double power = 0, supply = 0;  ///< power of friction and of the loads at `time`
  double dissipated = 0, supplied = 0;
  std::vector<double> strength;  ///< friction in each cell: a rate, or a force if the law has strength at rest
  std::vector<double> states;    ///< state variables of friction in each cell; empty: none
  double met_at = -1;            ///< time at which lines of different directions met; < 0: not yet
};

class GridSteps {
 public:
  GridSteps(const Problem& problem, const Cells& cells, GridMotion& motion, int threads);
  /// Advances by the longest stable step, or by a part of it so that whole steps end at `end`.
  void take(double end);
  /// Finds the states, the rates and the powers at the present time.
  void look();

  /// The steps in a time, if they are as long as the next one.
  StepsAhead ahead(double duration) const;
  const GridEquations& equations() const { return equations_; }
  /// The guesses with which the last look began. A run that resumes from them, and not from those that the look left,
  /// finds the states of the last look to the last bit.
  const GridEquations::Guesses& guesses() const { return guesses_; }
  void set_guesses(const GridEquations::Guesses& guesses) { equations_.set_guesses(guesses); }
  const Walls& walls() const { return walls_; }
  const Averages& rates() const { return rate_; }  ///< without friction, at the last look

 private:
  void look_after(double half_step);
  void hold();
  void refuse_steep_edge(std::size_t cell) const;
  void release();
  double forcing_at(std::size_t cell, double t);
  void add_loads(double t);
  void find_strengths();
  void find_forces();
  void age(double time);
  void slow(double time);
  void stage(double t, double step, double of_old);
  void slow_implicitly(double step, std::size_t first, std::size_t last);
  void remove_idle_actions();
  /// The cell in which friction limits the step most; empty if it limits none.
  std::optional<std::size_t> slowest_cell() const;
  double longest_step() const;
  friction::LocalState state_of(std::size_t cell) const { return {motion_.states.data() + cell * each_, each_}; }
  bool is_free(std::size_t cell) const { return !patch_.empty() && patch_[cell] != 0; }
  /// Whether friction does not act in a cell, because nucleation has begun there.
  bool is_released(std::size_t cell) const {
    return acts_in_stages_ && is_free(cell) && problem_.nucleation_has_begun(motion_.time);
  }

  const Problem& problem_;
  const Cells& cells_;
  GridMotion& motion_;
  Walls walls_;
  GridEquations equations_;
  GridEquations::Guesses guesses_;
  Front front_;
  bool friction_acts_;
  bool acts_in_stages_;                 ///< friction acts after each stage, not before and after a step
  bool sticks_;                         ///< friction has strength at rest
  std::size_t each_ = 0;                ///< state variables of a cell
  std::vector<char> patch_;             ///< whether each cell lies in the nucleation patch; empty: none
  std::vector<double> held_;            ///< static load; empty: none
  std::vector<double> steady_forcing_;  ///< NaN where it is not known yet
  Averages rate_, old_;
  std::vector<double> free_;  ///< wave action of a stage, without friction at first

  /// Trains that friction slows by an implicit step, row by row, and the results, by cell.
  struct Slowed {
    std::vector<pulse::SlowedTrains> rows;
    std::vector<double> momentum, velocity, typical_speed, force, slope, s;
    std::vector<double> fastest, state_values, mean_force;  ///< by train, at the end of a step
    Slowed(const friction::Friction& friction, const Cells& cells);
  };
  std::unique_ptr<Slowed> slowed_;  ///< null unless friction rises steeply from rest without strength
};

}  // namespace slipfront::plane
