#pragma once
/// \file
/// The modulation equations with friction, Eqs. (7), solved in the coordinate that counts dislocations
/// (docs/theory.md 3.4):
///     l_t = U_q,   M_t + p_q = 2 pi F - friction,   p = 2 sinh^2 psi.
/// Finite volumes in a coordinate s, one cell a unit, with q(s) fixed: the number of dislocations in a cell never
/// changes, an empty region is a free edge (p = 0) and no cell, and a slow pulse (V ~ 1e-26) is computed like a fast
/// one.

#include <functional>
#include <memory>
#include <vector>

#include "slipfront/modulation/friction.hpp"
#include "slipfront/train/state.hpp"

namespace slipfront::pulse {

class Semidiscrete;

/// What to solve.
struct Problem {
  std::function<double(double)> stress;               ///< initial stress at x, >= 0; the interface is at rest
  std::function<double(double x, double t)> forcing;  ///< F; null: none
  modulation::Friction friction;
  double left = -1, right = 1;  ///< domain at t = 0
  double corner = 0;            ///< x of a step of stress: a face is laid there
  int cells = 400;              ///< over the part of the domain that is not empty, >= 4
  double tolerance = 1e-6;      ///< relative, of the implicit steps
  double cfl = 1.0;             ///< of the explicit steps; smooth problems bear 1.4, steps of stress do not
};

/// The state of a run. Plain numbers: saved and restored, a run continues to the same bits.
struct Cells {
  double time = 0;
  long steps = 0;
  double step = 0;  ///< last step of the implicit integrator, 0 before the first
  std::vector<double>
      y;  ///< width and momentum of each cell in turn, x of the left edge, energy dissipated, energy supplied
  std::vector<double> s;  ///< tanh(psi) at the cell centres, where the next solve starts
};

class Solver {
 public:
  /// Lays the cells, evenly in x over the stretch where there is stress. \throws InputError for an empty interface, an
  /// empty gap between stressed parts, or bad numbers.
  explicit Solver(Problem problem);

  /// Continues from saved cells of the same problem. \throws InputError if they do not fit it.
  Solver(Problem problem, Cells cells);

  /// Goes back (or on) to saved cells of the same problem. \throws InputError if they do not fit it.
  void restore(Cells cells);

  /// Advances to `time`. `interrupted` is asked after each step; true stops early. Returns whether `time` was reached.
  /// \throws NumericsError with the time and place where no state exists.
  bool advance_to(double time, const std::function<bool()>& interrupted = {});

  const Problem& problem() const { return problem_; }
  const Cells& cells() const { return cells_; }
  std::size_t size() const { return charge_.size(); }
  /// Dislocations in each cell, constant.
  const std::vector<double>& charge() const { return charge_; }

  /// What the interface looks like now, for interpolation and sums.
  struct View {
    std::vector<double> faces;         ///< x
    std::vector<double> charge_faces;  ///< dislocations left of each face
    std::vector<State> face_states;
    std::vector<double> centres;  ///< x
    std::vector<State> states;    ///< at the centres
  };
  View view() const;
  /// State at the centre of one cell, as in the view, without making it.
  State state_in(std::size_t cell) const;
  /// Number of dislocations left of x at t = 0.
  double initial_charge_left_of(double x) const;

  double dissipated() const { return cells_.y[2 * size() + 1]; }
  double supplied() const { return cells_.y[2 * size() + 2]; }

 private:
  Problem problem_;
  Cells cells_;
  std::vector<double> charge_;
  View first_;
  std::shared_ptr<Semidiscrete> equations_;
};

/// State at x between the dislocations of a view; empty outside.
State state_at(const Solver::View& view, double x);
/// Number of dislocations left of x.
double charge_left_of(const Solver::View& view, double x);

}  // namespace slipfront::pulse
