#include "run/plane.hpp"

#include <algorithm>
#include <cstddef>
#include <span>
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

/// The numbers at the end of a run.
std::vector<Row> rows_at_end(const plane::Run& run, const scenario::Scenario& s, double wall) {
  return rows_of(plane::Report{.run = run,
                               .maps = run.maps(),
                               .slip_at_probes = run.solver().slip(s.plane->probes),
                               .slip_velocity_at_probes = run.solver().velocity(s.plane->probes),
                               .wall = wall});
}

/// The numbers with a fraction of the cells or of the scale; empty if the run fails or is interrupted.
std::vector<Row> with_fewer_cells(scenario::Scenario s, int divisor, const std::function<bool()>& interrupted,
                                  scenario::Lines lines, int threads) {
  if (lines == scenario::Lines::direct) s.chain.scale = scenario::scale_of_lines(s) / divisor;
  s.plane->loops = std::max(4, s.plane->loops / divisor);
  s.plane->angles = std::max(8, s.plane->angles / divisor);
  if (lines == scenario::Lines::averaged) s.plane->cells = std::max(8, s.plane->cells / divisor);
  try {
    plane::Schedule schedule = scenario::plane_schedule(s, lines);
    schedule.times = {s.end};
    plane::Run run(scenario::plane_solver(s, lines, threads), std::move(schedule));
    return run.go(interrupted) ? rows_at_end(run, s, 0) : std::vector<Row>{};
  } catch (const NumericsError&) {
    return {};
  } catch (const InputError&) {  // fewer cells do not see a held region
    return {};
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
  PlaneResult result{
      .run = begun(s, plan, options),
      .metadata = metadata_of(s, plan.lines == scenario::Lines::direct ? "plane --direct" : "plane", {})};
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
  result.summary = rows_at_end(*result.run, s, seconds_since(options.begun));
  return result;
}

void add_errors(PlaneResult& fine, const scenario::Scenario& s, const std::function<bool()>& interrupted,
                scenario::Lines lines, int threads) {
  if (lines == scenario::Lines::direct && s.chain.scale) {
    scenario::Scenario by_default = s;
    by_default.chain.scale.reset();
    if (*s.chain.scale < scenario::scale_of_lines(by_default)) return;
  }
  const std::vector<Row> half = with_fewer_cells(s, 2, interrupted, lines, threads),
                         quarter = with_fewer_cells(s, 4, interrupted, lines, threads);
  if (half.empty() || quarter.empty()) return;
  for (std::size_t row = 0; row < fine.summary.size(); ++row) {
    if (fine.summary[row].about.error == ErrorRule::unknown) continue;
    const std::span<const double> f = fine.summary[row].reals(), h = half[row].reals(), q = quarter[row].reals();
    for (std::size_t i = 0; i < f.size(); ++i) fine.summary[row].errors.push_back(safety * change_of(f[i], h[i], q[i]));
  }
}

}  // namespace slipfront::run
