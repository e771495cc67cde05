#pragma once
/// \file
/// Turns a scenario into the problems that solvers solve, on a line and on a plane, and into the times of their
/// results.

#include <memory>
#include <optional>
#include <vector>

#include "slipfront/averages/pulse/run.hpp"
#include "slipfront/lattice/chain/run.hpp"
#include "slipfront/lattice/plane/run.hpp"
#include "slipfront/scenario/scenario.hpp"

namespace slipfront {
class Ranks;
}

namespace slipfront::scenario {

/// The times of the results of a scenario, ascending: 0, those of [output], and the end.
std::vector<double> output_times(const Scenario& scenario);

/// The problem of a scenario that pulse and chain share. If the scenario gives no domain, we choose one that contains
/// all waves until the end. \throws InputError if that is impossible, so that the scenario must give the domain.
pulse::Problem stated_problem(const Scenario& scenario);

/// The problem for the pulse solver. \throws InputError also for scenarios that need the chain solver, because averages
/// over a train do not describe them. Such a scenario has springs that load every site, friction that changes contacts
/// or pores, or no substrate. (Under springs, dislocations are created; the averaged equations conserve them.)
pulse::Problem pulse_problem(const Scenario& scenario);

/// Output times and output grid: t = 0, the output times of the scenario, and the end. \throws InputError if the
/// results would not fit into memory.
output::Schedule pulse_schedule(const Scenario& scenario, const pulse::Problem& problem);

/// The chain problem of a scenario, on the same domain as its pulse. \throws InputError if the scenario has none.
chain::ScaledProblem chain_problem(const Scenario& scenario);

/// \throws InputError if the scenario has no table [plane].
void require_plane(const Scenario& scenario);
/// \throws InputError if the scenario has the table [plane].
void require_line(const Scenario& scenario);

/// The scale of a direct run. Unless the scenario has chain.scale, the largest initial slip has at least 20 lines, and
/// the scale is a whole number. Without initial slip it is 1.
double scale_of_lines(const Scenario& scenario);

/// The solver of a scenario on a plane. \throws InputError for what it cannot solve, and for a direct solver that needs
/// more memory than this process may have. `ranks` are the processes that share a direct solver (plane::DirectOptions).
std::unique_ptr<plane::Solver> plane_solver(const Scenario& scenario, SolverKind solver, int threads,
                                            const Ranks* ranks = nullptr);

/// The times and the grid of the results, and the slip at which a cell has ruptured, which depends on the solver. A row
/// of the series follows each time in which a wave crosses a cell, with at most 1000 rows. \throws InputError if the
/// results need more memory than this process may have.
plane::Schedule plane_schedule(const Scenario& scenario, SolverKind solver);

/// A position on a line (y = 0) or a plane, in the coordinates of the scenario, and the value of a number there.
struct ValueAt {
  double value, x, y;
};

/// The least and the largest value of a number along the interface.
struct Range {
  ValueAt least, largest;
};

/// Absent numbers do not apply to the scenario. Lengths are in b / A, stiffness in the unit of the model.
struct Numbers {
  /// The position with the largest critical stiffness, if friction or springs vary. The other numbers of friction are
  /// those there. On a plane `position_y` is its y.
  std::optional<double> position = {}, position_y = {};
  std::optional<double> strength_over_direct_effect;  ///< f_0 / a of rate-and-state friction
  /// kappa_c = ((b - a) / D_c) (1 + v^2 / (a D_c)) at the velocity v of the springs: softer springs let steady sliding
  /// become unstable (docs/loading.md).
  std::optional<double> critical_stiffness;
  std::optional<double> stiffness_ratio;  ///< kappa / kappa_c, if the springs pull everywhere
  /// 2 pi / sqrt(kappa_c - kappa), the shortest wave along the interface that grows without a substrate. A shorter
  /// interface slides steadily.
  std::optional<double> nucleation_length;
  /// The ranges of three of these numbers, if friction or springs vary. That of the nucleation length is over the
  /// positions where steady sliding is unstable, and absent without such positions.
  std::optional<Range> strength_over_direct_effect_range = {}, stiffness_ratio_range = {}, nucleation_length_range = {};
  std::optional<double> dislocations;  ///< in the domain at t = 0
  std::optional<double> length;        ///< length of the domain
};

/// \throws InputError if the domain is needed and not given.
Numbers numbers_of(const Scenario& scenario);

}  // namespace slipfront::scenario
