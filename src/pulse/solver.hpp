#pragma once
/// \file
/// The modulation equations with friction, solved in the coordinate that counts dislocations (docs/theory.md 3.4):
///     l_t = U_q,   M_t + p_q = 2 pi F - friction,   p = 2 sinh^2 psi.
/// Finite volumes in a coordinate s, one cell a unit, with q(s) fixed: the number of dislocations in a cell never
/// changes, an empty region is a free edge (p = 0) and no cell, and a slow pulse (V ~ 1e-26) is computed like a fast
/// one.

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "pulse/grid/cells.hpp"
#include "pulse/view/view.hpp"
#include "slipfront/pulse/problem.hpp"

namespace slipfront::pulse {

class Solver {
 public:
  using View = pulse::View;

  /// Places cells where there is stress. \throws InputError for an empty interface or bad numbers.
  explicit Solver(Problem problem);
  /// Continues from saved cells of the same problem. \throws InputError if they do not fit it.
  Solver(Problem problem, Cells cells);
  ~Solver();
  Solver(Solver&&) noexcept;
  Solver& operator=(Solver&&) noexcept;

  /// Replaces the cells by saved cells of the same problem. \throws InputError if they do not fit it.
  void restore(Cells cells);

  /// Advances to `time`. `interrupted` is asked after each step; true stops early. Returns whether `time` was reached.
  /// \throws NumericsError with the time and position where no state exists.
  bool advance_to(double time, const std::function<bool()>& interrupted = {});

  /// About how many steps the next `duration` takes: those that waves allow, or fewer where viscous friction rules.
  double expected_steps(double duration) const;
  /// The reason for short steps, with the position, as a sentence without a full stop for a message.
  std::string reason_of_short_steps() const;

  const Problem& problem() const;
  const Cells& cells() const;
  /// Cells, gaps included.
  std::size_t size() const { return cells().size(); }
  const std::vector<double>& charge() const { return cells().charge; }

  /// The state of the interface now, for interpolation and sums. Without `densities`, which take as long as the rest,
  /// face_density is empty.
  View view(bool densities = true) const;
  /// State at the centre of one cell, as in the view, without making it.
  State state_in(std::size_t cell) const;
  /// Slip at x since t = 0 (observe/slip.hpp).
  double slip_at(const View& view, double x) const;

  double dissipated() const { return cells().values().dissipated(); }
  double supplied() const { return cells().values().supplied(); }
  /// Energy that came in through the ends of the domain, less what went out: with the dislocations, and by the push of
  /// the train outside.
  double through_ends() const { return cells().values().through_ends(); }

 private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

}  // namespace slipfront::pulse
