#pragma once
/// \file
/// Turns a scenario on a plane into a solver and the times of its results.

#include <memory>

#include "slipfront/plane/run.hpp"
#include "slipfront/scenario/scenario.hpp"

namespace slipfront {
class Ranks;
}

namespace slipfront::setup {

/// \throws InputError if the scenario has no table [plane].
void require_plane(const scenario::Scenario& scenario);
/// \throws InputError if the scenario has the table [plane].
void require_line(const scenario::Scenario& scenario);

/// Whether a run follows the averages or every dislocation line.
enum class Lines { averaged, direct };

/// The scale of a direct run. Unless the scenario has chain.scale, the largest initial slip has at least 20 lines, and
/// the scale is a whole number. Without initial slip it is 1.
double scale_of_lines(const scenario::Scenario& scenario);

/// The solver of a scenario. \throws InputError for what it cannot solve, and for a direct solver that needs more
/// memory than this process may have.
/// `ranks` are the processes that share a direct solver (plane::DirectOptions).
std::unique_ptr<plane::Solver> plane_solver(const scenario::Scenario& scenario, Lines lines, int threads,
                                            const Ranks* ranks = nullptr);

/// The times and the grid of the results, and the slip at which a cell has ruptured, which depends on `lines`. A row of
/// the series follows each time in which a wave crosses a cell, with at most 1000 rows. \throws InputError if the
/// results need more memory than this process may have.
plane::Schedule plane_schedule(const scenario::Scenario& scenario, Lines lines);

/// Approximate number of bytes of the file of a run.
double plane_file_size(const plane::Schedule& schedule);

}  // namespace slipfront::setup
