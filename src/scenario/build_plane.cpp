#include <algorithm>
#include <cmath>
#include <numbers>

#include "foundation/machine.hpp"
#include "foundation/ranks.hpp"
#include "foundation/text/digits.hpp"
#include "scenario/solver_errors.hpp"
#include "slipfront/error.hpp"
#include "slipfront/plane/solvers.hpp"
#include "slipfront/scenario/problem.hpp"

namespace slipfront::scenario {
namespace {

/// The largest initial slip, which no solver takes below 0, on the grid of the results.
double largest_slip(const plane::Problem& p, int nx, int ny) {
  double largest = 0;
  for (int j = 0; j < ny; ++j)
    for (int i = 0; i < nx; ++i)
      largest = std::fmax(largest, p.slip(p.left + (p.right - p.left) * (i + 0.5) / nx,
                                          p.bottom + (p.top - p.bottom) * (j + 0.5) / ny));
  return largest;
}

}  // namespace

void require_plane(const Scenario& s) {
  if (!s.plane)
    throw InputError(
        {.file = s.file, .key = "plane", .problem = "this table is missing", .allowed = "[plane] left = ..."});
}

void require_line(const Scenario& s) {
  if (s.plane)
    throw InputError({.file = s.file,
                      .key = "plane",
                      .problem = "the scenario is on a plane, and this command runs on a line",
                      .allowed = "slipfront plane"});
}

double scale_of_lines(const Scenario& s) {
  constexpr double enough = 20;
  constexpr int samples = 100;
  if (s.chain.scale) return *s.chain.scale;
  const double largest = largest_slip(s.plane->problem, samples, samples);
  return largest > 0 ? std::fmax(1, std::ceil(enough * 2 * std::numbers::pi / largest)) : 1;
}

std::unique_ptr<plane::Solver> plane_solver(const Scenario& s, SolverKind solver, int threads, const Ranks* ranks) {
  require_plane(s);
  const char* const slip_key = s.initial.file.empty() ? "initial.formula" : "initial.file";
  const auto make = [&]() -> std::unique_ptr<plane::Solver> {
    if (solver == SolverKind::plane && s.plane->on_grid) return plane::grid_solver(s.plane->problem, s.plane->cells);
    if (solver == SolverKind::plane)
      return plane::loops_solver(s.plane->problem, {.loops = s.plane->loops, .angles = s.plane->angles});
    const plane::DirectOptions options{.scale = scale_of_lines(s),
                                       .spacing = s.chain.spacing.value_or(plane::DirectOptions{}.spacing),
                                       .threads = threads,
                                       .ranks = ranks};
    const double share = ranks ? ranks->share_of_machine() : 1;
    const double need = share * plane::memory_of_direct(s.plane->problem, options);
    if (need > usable_memory())
      throw InputError({.key = "scale",
                        .value = digits(options.scale),
                        .problem = "the lines need " + digits(need / 1e9, 3) + " GB of memory, this process may have " +
                                   digits(usable_memory() / 1e9, 3) + " GB",
                        .allowed = "a smaller scale"});
    return plane::direct_solver(s.plane->problem, options);
  };
  return with_keys(solver, s.file, make, slip_key);
}

namespace {

/// When a cell has ruptured, as a number and in the words that files have.
void set_rupture_rule(const Scenario& s, SolverKind solver, plane::Schedule& schedule) {
  const plane::Problem& p = s.plane->problem;
  // A state that is held settles a little at t = 0. There, and without initial slip, half a line must pass.
  const double seen = p.nucleation ? 1e-2 : 1e-3, largest = largest_slip(p, schedule.nx, schedule.ny);
  schedule.rupture_slip = seen * largest;
  const std::string when = "time at which the slip, of either sign, first exceeds ";
  schedule.rupture_rule = when + digits(seen) + " of the largest initial mean slip";
  if (solver != SolverKind::plane_direct || !(p.nucleation || !(largest > 0))) return;
  const double half_a_line = std::numbers::pi / scale_of_lines(s);
  schedule.rupture_rule =
      largest > 0 ? schedule.rupture_rule + " and that of half a line" : when + "that of half a line";
  schedule.rupture_slip = std::fmax(schedule.rupture_slip, half_a_line);
}

}  // namespace

plane::Schedule plane_schedule(const Scenario& s, SolverKind solver) {
  require_plane(s);
  constexpr double most_rows = 1000;
  const plane::Problem& p = s.plane->problem;
  const double width = p.right - p.left, cell = width / s.plane->cells;
  plane::Schedule schedule;
  schedule.times = output_times(s);
  schedule.nx = s.plane->cells;
  schedule.ny = p.rows_of_cells(schedule.nx);
  const double need = 2 * plane::memory_of_results(schedule);
  if (need > usable_memory())
    throw InputError({.file = s.file,
                      .key = "plane.cells",
                      .problem = "the results need " + digits(need / 1e9, 3) + " GB of memory, this process may have " +
                                 digits(usable_memory() / 1e9, 3) + " GB",
                      .allowed = "fewer cells or fewer output times"});
  schedule.interval = std::fmax(cell, s.end / most_rows);
  set_rupture_rule(s, solver, schedule);
  schedule.wave_speed_ratio = s.plane->wave_speed_ratio;
  schedule.lines = s.plane->lines;
  return schedule;
}

}  // namespace slipfront::scenario
