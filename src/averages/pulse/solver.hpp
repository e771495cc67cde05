#pragma once
/// \file
/// The modulation equations with friction, solved in the coordinate that counts dislocations
/// (docs/theory/3_modulation.md 3.4):
///     l_t = U_q,   M_t + p_q = 2 pi F - friction,   p = 2 sinh^2 psi.
/// We use finite volumes in a coordinate s, in which each cell has unit length, with q(s) fixed. The number of
/// dislocations in a cell therefore never changes. An empty region needs no grid: its boundary is a free edge (p = 0).
/// A slow pulse (V ~ 1e-26) is computed in the same way as a fast one.

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "averages/pulse/grid/cells.hpp"
#include "averages/pulse/view/view.hpp"
#include "slipfront/averages/pulse/problem.hpp"

namespace slipfront::pulse {

class Solver {
 public:
  using View = pulse::View;

  /// Creates cells where there is stress. \throws InputError if there is no stress, or if a setting is invalid.
  explicit Solver(Problem problem);
  ~Solver();
  Solver(Solver&&) noexcept;
  Solver& operator=(Solver&&) noexcept;

  /// Approximate number of bytes of a solver with this number of cells, and of its saved state in a file.
  static double memory_needed(int cells);
  static double disk_needed(int cells);

  /// Replaces the cells by other cells of the same problem. \throws InputError if they do not fit it.
  void restore(Cells cells);
  void archive(Archive& a);

  /// Advances to `time`. Calls `interrupted` after each step, and stops early if it returns true. Returns whether
  /// `time` was reached. \throws NumericsError with the time and position where no state exists.
  bool advance_to(double time, const std::function<bool()>& interrupted = {});

  /// Whether the last step might have been different if the `time` of advance_to had been later.
  bool aimed_at_time() const;

  /// Approximate number of steps in the next `duration`: as many as waves require, or fewer if viscous friction
  /// dominates.
  double expected_steps(double duration) const;
  /// Reason for short steps, with the position, as a sentence without a full stop for use in a message.
  std::string reason_of_short_steps() const;

  const Problem& problem() const;
  const Cells& cells() const;
  /// Number of cells, gaps included.
  std::size_t size() const { return cells().size(); }
  const std::vector<double>& charge() const { return cells().charge; }

  /// State of the interface now, for interpolation and sums. Without `densities`, which cost as much as the rest,
  /// face_density is empty.
  View view(bool densities = true) const;
  /// State at the centre of one cell, as in the view but without the cost of a view.
  State state_in(std::size_t cell) const;
  /// Slip at x since t = 0 (observe/slip.hpp).
  double slip_at(const View& view, double x) const;

  double dissipated() const { return cells().values().dissipated(); }
  double supplied() const { return cells().values().supplied(); }
  /// Energy that has entered through the ends of the domain, less the energy that has left. It is the energy of the
  /// dislocations that pass, and the work of the train outside.
  double through_ends() const { return cells().values().through_ends(); }

 private:
  struct Impl;
  std::unique_ptr<Impl> parts_;
};

}  // namespace slipfront::pulse
