#include "run/plane.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "foundation/text/digits.hpp"
#include "run/carry_out.hpp"
#include "run/errors.hpp"

namespace slipfront::run {
namespace {

std::unique_ptr<plane::Run> begun(const scenario::Scenario& s, const PlanePlan& plan, const Options& options) {
  std::unique_ptr<plane::Solver> solver = scenario::plane_solver(s, plan.lines, options.threads, options.ranks);
  if (!options.checkpoint) return std::make_unique<plane::Run>(std::move(solver), plan.schedule);
  const record::Checkpoint& saved = *options.checkpoint;
  return std::make_unique<plane::Run>(std::move(solver), plan.schedule, saved.solver_state, saved.fields);
}

/// All numbers that have an error, in one row.
std::vector<double*> all_of(PlaneNumbers& n) {
  plane::Energies& e = n.end.energies;
  std::vector<double*> all = {&n.end.potency, &n.end.potency_rate, &n.end.front, &e.kinetic, &e.elastic,
                              &e.dissipated,  &e.supplied,         &e.vanished,  &e.radiated};
  for (auto* list : {&n.slip_at_probes, &n.slip_velocity_at_probes})
    for (double& value : *list) all.push_back(&value);
  return all;
}

/// The numbers at the end of a run.
PlaneNumbers numbers_of(const plane::Run& run, const scenario::Scenario& s) {
  return {.end = run.series().back(),
          .slip_at_probes = run.solver().slip(s.plane->probes),
          .slip_velocity_at_probes = run.solver().velocity(s.plane->probes)};
}

/// The numbers with a fraction of the cells or of the scale; empty if the run fails or is interrupted.
std::optional<PlaneNumbers> with_fewer_cells(scenario::Scenario s, int divisor,
                                             const std::function<bool()>& interrupted, scenario::Lines lines,
                                             int threads) {
  if (lines == scenario::Lines::direct) s.chain.scale = scenario::scale_of_lines(s) / divisor;
  s.plane->loops = std::max(4, s.plane->loops / divisor);
  s.plane->angles = std::max(8, s.plane->angles / divisor);
  if (lines == scenario::Lines::averaged) s.plane->cells = std::max(8, s.plane->cells / divisor);
  try {
    plane::Schedule schedule = scenario::plane_schedule(s, lines);
    schedule.times = {s.end};
    plane::Run run(scenario::plane_solver(s, lines, threads), std::move(schedule));
    return run.go(interrupted) ? std::optional(numbers_of(run, s)) : std::nullopt;
  } catch (const NumericsError&) {
    return std::nullopt;
  } catch (const InputError&) {  // fewer cells do not see a held region
    return std::nullopt;
  }
}

}  // namespace

PlanePlan plan_plane(const scenario::Scenario& s, scenario::Lines lines) {
  PlanePlan plan{.lines = lines, .schedule = scenario::plane_schedule(s, lines), .grid = {}, .disk = 0};
  plan.disk = scenario::plane_file_size(plan.schedule);
  const plane::Problem& p = s.plane->problem;
  const double ratio = s.plane->wave_speed_ratio;
  plan.grid = {.left = p.left,
               .right = p.right,
               .bottom = ratio * p.bottom,
               .top = ratio * p.top,
               .nx = plan.schedule.nx,
               .ny = plan.schedule.ny};
  return plan;
}

PlaneResult plane(const scenario::Scenario& s, const PlanePlan& plan, const Options& options) {
  PlaneResult result{.run = begun(s, plan, options),
                     .metadata = metadata_of(s, plan.lines == scenario::Lines::direct ? "plane --direct" : "plane", {}),
                     .wall = 0};
  const auto write = [&](const std::string& path, const record::PulseMetadata& metadata, const std::string& state) {
    record::write_plane(path, metadata, plan.grid, *result.run, state);
  };
  if (!carry_out(result, options, plan.disk, write)) return result;
  if (const double scale = scenario::scale_of_lines(s);
      plan.lines == scenario::Lines::direct && !s.chain.scale && scale > 1)
    add_warnings({"chain.scale is not given. At scale " + digits(scale) +
                  " the largest initial slip has 20 dislocation lines; a larger one brings results closer to those of "
                  "many lines"},
                 result.metadata);
  result.numbers = numbers_of(*result.run, s);
  result.wall = seconds_since(options.begun);
  return result;
}

PlaneNumbers unknown_errors(PlaneNumbers numbers) {
  for (double* const number : all_of(numbers)) *number = std::numeric_limits<double>::quiet_NaN();
  return numbers;
}

PlaneNumbers plane_errors(const scenario::Scenario& s, const PlaneNumbers& numbers,
                          const std::function<bool()>& interrupted, scenario::Lines lines, int threads) {
  if (lines == scenario::Lines::direct && s.chain.scale) {
    scenario::Scenario by_default = s;
    by_default.chain.scale.reset();
    if (*s.chain.scale < scenario::scale_of_lines(by_default)) return unknown_errors(numbers);
  }
  const std::optional<PlaneNumbers> half_of = with_fewer_cells(s, 2, interrupted, lines, threads),
                                    quarter_of = with_fewer_cells(s, 4, interrupted, lines, threads);
  if (!half_of || !quarter_of) return unknown_errors(numbers);
  PlaneNumbers fine = numbers, half = *half_of, quarter = *quarter_of, errors = numbers;
  const std::vector<double*> f = all_of(fine), h = all_of(half), q = all_of(quarter), e = all_of(errors);
  for (std::size_t i = 0; i < e.size(); ++i) *e[i] = safety * change_of(*f[i], *h[i], *q[i]);
  return errors;
}

}  // namespace slipfront::run
