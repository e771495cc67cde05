#include "runs/compare.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include "math/constants.hpp"
#include "math/digits.hpp"
#include "math/roots.hpp"
#include "scenario/estimate.hpp"
#include "slipfront/error.hpp"
#include "slipfront/text/output/quantities.hpp"
#include "slipfront/theory/rupture/riemann_trains.hpp"
#include "slipfront/theory/train.hpp"
#include "system/machine.hpp"

namespace slipfront::run {
namespace {

std::vector<double> checked(std::vector<double> scales, const scenario::Scenario& s) {
  const auto refuse = [](double scale, const char* problem, const char* allowed) {
    throw InputError(
        {.file = "command line", .key = "--scale", .value = digits(scale), .problem = problem, .allowed = allowed});
  };
  for (const double scale : scales)
    if (!(scale > 0) || !std::isfinite(scale)) refuse(scale, "out of range", "> 0");
  if (scales.empty()) scales = s.chain.scale ? std::vector{*s.chain.scale} : std::vector{100.0, 300.0, 1000.0};
  std::sort(scales.begin(), scales.end());
  if (const auto twice = std::adjacent_find(scales.begin(), scales.end()); twice != scales.end())
    refuse(*twice, "given twice", "each scale once");
  return scales;
}

ComparedModel level_of(const Plan& plan) {
  if (plan.solver == scenario::SolverKind::chain)
    return {.name = "chain-" + digits(plan.chain.scale), .scale = plan.chain.scale};
  const char* const closure = name_of(plan.pulse.friction.closure());
  return {.name = std::string("pulse-") + closure, .closure = closure};
}

std::vector<record::Level> levels_of(const std::vector<ComparedModel>& models) {
  std::vector<record::Level> levels;
  levels.reserve(models.size());
  for (const ComparedModel& model : models)
    levels.push_back({model.name, model.scale.value_or(none), &model.snapshots});
  return levels;
}

/// Runs one level to its end; false if stopped.
bool carry(const Plan& plan, int threads, ComparedModel& level,
           const std::function<bool(double time, long steps)>& after_step) {
  const auto begun = Clock::now();
  const Result result = begin(plan, {.threads = threads});
  output::Run& run = *result.run;
  bool reached = false;
  try {
    reached = run.go([&] { return after_step(run.time(), run.steps()); });
  } catch (const NumericsError& error) {
    throw NumericsError(level.name + ": " + error.what());
  }
  level.wall_seconds = seconds_since(begun);
  level.snapshots = result.snapshots();
  level.warnings = run.warnings();
  if (reached) level.numbers = result.numbers({});
  return reached;
}

}  // namespace

std::optional<double> ComparedModel::number(const Description& about) const {
  for (const Row& row : numbers)
    if (row.about.name == about.name) return row.number();
  return {};
}

Comparison comparison_of(const scenario::Scenario& scenario, std::vector<double> scales) {
  Comparison c;
  std::vector<chain::ScaledProblem> chains;
  for (const friction::Closure closure : {friction::Closure::consistent, friction::Closure::paper}) {
    if (!scenario.friction.defined_by(closure)) continue;
    scenario::Scenario with_closure = scenario;
    with_closure.friction = scenario.friction.with(closure);
    c.plans.push_back(plan_of(scenario::SolverKind::pulse, std::move(with_closure)));
  }
  c.schedule = c.plans.front().on_line;
  for (const double scale : checked(std::move(scales), scenario)) {
    scenario::Scenario scaled = scenario;
    scaled.chain.scale = scale;
    c.plans.push_back(plan_of(scenario::SolverKind::chain, std::move(scaled)));
    chains.push_back(c.plans.back().chain);
  }
  scenario::require_memory(scenario, chains);  // before the closed form, which is observed at once
  c.need = scenario::estimate_of(scenario, chains);
  c.exact = closed_form(scenario, c.schedule);
  return c;
}

void begin_levels(const Comparison& c) {
  for (const Plan& plan : c.plans) begin(plan, {});
}

double expected_seconds(const Comparison& c, int threads) {
  double seconds = 0;
  for (const Plan& plan : c.plans) {
    const Options options{.threads = threads};
    Result level = begin(plan, options);
    level.cost_of_errors = 0;  // a comparison has none
    seconds += expected_duration(level, plan, options, 0.5 / static_cast<double>(c.plans.size())).seconds;
  }
  return seconds;
}

std::vector<record::Array> arrays_of(const Comparison& c, const record::RunMetadata& metadata,
                                     const std::vector<ComparedModel>& levels) {
  return record::arrays_of(c.schedule, metadata.variables, levels_of(levels));
}

bool compare(const Comparison& c, const record::RunMetadata& metadata, const record::Output& output, int threads,
             std::vector<ComparedModel>& levels, const std::function<void()>& next,
             const std::function<bool(const std::string& level, double time, long steps)>& after_step) {
  const auto write = [&](bool finished) {
    if (!output.wanted()) return;
    record::write_comparison(finished ? output.finished() : output.unfinished(), metadata,
                             arrays_of(c, metadata, levels), levels_of(levels), finished);
    if (finished) output.clear();
  };
  if (c.exact) levels.push_back(*c.exact);
  for (const Plan& plan : c.plans) {
    next();
    write(false);
    ComparedModel level = level_of(plan);
    const auto after = [&](double time, long steps) { return after_step(level.name, time, steps); };
    if (!carry(plan, threads, level, after)) return write(false), false;
    levels.push_back(std::move(level));
  }
  write(true);
  return true;
}

const std::vector<output::Scalar>& compared_numbers() {
  static const std::vector<output::Scalar> compared = [] {
    std::vector<output::Scalar> all(output::scalars().begin(), output::scalars().end());
    std::erase_if(all, [](const output::Scalar& number) { return number.heading.empty(); });
    return all;
  }();
  return compared;
}

const ComparedModel* reference_level(const std::vector<ComparedModel>& levels) {
  for (const ComparedModel& level : levels)
    if (level.name == "pulse-consistent" && !level.snapshots.empty()) return &level;
  return nullptr;
}

Trend trend_of(const std::vector<ComparedModel>& levels, const output::Scalar& number) {
  Trend trend;
  const ComparedModel* reference = reference_level(levels);
  if (!reference) return trend;
  const double theory = number.get(reference->snapshots.back());
  std::vector<double> scale, value;  // ascending
  for (const ComparedModel& level : levels)
    if (level.scale && !level.snapshots.empty()) {
      scale.push_back(*level.scale);
      value.push_back(number.get(level.snapshots.back()));
    }
  const std::size_t n = scale.size();
  if (n < 2) return trend;
  double x = 0, y = 0, xx = 0, xy = 0;
  for (std::size_t i = 0; i < n; ++i) {
    const double a = std::log(scale[i]), b = std::log(std::fabs(value[i] - theory));
    x += a;
    y += b;
    xx += a * a;
    xy += a * b;
  }
  const auto count = static_cast<double>(n);
  trend.exponent = -(count * xy - x * y) / (count * xx - x * x);
  if (trend.exponent < 0) return trend;  // the difference grows, so the values have no limit that we know
  trend.extrapolated = (scale[n - 1] * value[n - 1] - scale[n - 2] * value[n - 2]) / (scale[n - 1] - scale[n - 2]);
  trend.difference = trend.extrapolated - theory;
  return trend;
}

namespace {

/// The reason why quantities have no value at infinite scale. Empty if all have one.
std::string note_on_limits(const std::vector<ComparedModel>& levels) {
  std::string names;
  for (const output::Scalar& q : compared_numbers())
    if (trend_of(levels, q).exponent < 0) names += (names.empty() ? "" : ", ") + std::string(q.about.name);
  if (names.empty()) return {};
  return "no value at infinite scale for " + names +
         ": the difference between chain and pulse does not fall with the scale, over the scales run";
}

}  // namespace

std::vector<std::string> notes_on(const scenario::Scenario& s, const std::vector<ComparedModel>& levels) {
  std::vector<std::string> notes;
  const bool two_sides = s.initial.even_ends;
  if (!s.friction.acts() && !s.pulse.many_trains && two_sides && s.initial.stress_left > 0 &&
      s.initial.stress_right > 0 && s.initial.stress_left != s.initial.stress_right)
    notes.emplace_back(
        "without friction dislocations overtake each other, and one train with a shock loses their energy: no scale "
        "brings chain and pulse together, but pulse.trains = \"many\" does (docs/theory/9_trains.md)");
  notes.emplace_back(
      "* as an observer with a threshold sees it; on a chain with little friction phonons run ahead, and raising "
      "pulse.threshold hides them");
  if (const std::string note = note_on_limits(levels); !note.empty()) notes.push_back(note);
  notes.insert(notes.end(), s.warnings.begin(), s.warnings.end());
  for (const ComparedModel& level : levels)
    for (const std::string& warning : level.warnings) notes.push_back(level.name + ": " + warning);
  return notes;
}

namespace {

using rupture::Edges;
using rupture::TrainsSolution;

double velocity(const TrainsSolution& solution, double x_over_t) {
  return rupture::profile_point(solution, x_over_t).all.W;
}
double speed(const TrainsSolution& solution, double x_over_t) { return std::fabs(velocity(solution, x_over_t)); }

/// x/t of the greatest slip velocity. We take the best of many samples, and refine it by golden-section search between
/// its neighbours.
double peak_of(const TrainsSolution& solution, const Edges& edges) {
  constexpr int samples = 2000;
  const double width = edges.right - edges.left;
  const auto place = [&](int i) { return edges.left + width * i / samples; };
  int best = 1;
  double largest = speed(solution, place(best));
  for (int i = 2; i < samples; ++i)
    if (const double here = speed(solution, place(i)); here > largest) {
      best = i;
      largest = here;
    }
  double low = place(best - 1), high = place(best + 1);
  constexpr double golden = 0.6180339887498949;
  for (int i = 0; i < 60; ++i) {
    const double a = high - golden * (high - low), b = low + golden * (high - low);
    if (speed(solution, a) < speed(solution, b))
      low = a;
    else
      high = b;
  }
  return (low + high) / 2;
}

/// x/t between a position at rest and the peak, at which the slip velocity passes `level`. The slip velocity is
/// monotone in each wave.
double passes(const TrainsSolution& solution, double resting, double peak, double level) {
  const auto is_slower = [&](double x_over_t) { return speed(solution, x_over_t) < level; };
  return bisected({.holding = resting, .failing = peak}, is_slower).failing;
}

/// The rays x/t on which fronts and peak move: all states depend on x/t only.
struct Rays {
  double fast, slow;  ///< fronts
  double peak, peak_velocity;
  double fast_observed, slow_observed;  ///< fronts that an observer with a threshold sees
};
Rays rays_of(const TrainsSolution& solution, double threshold) {
  const Edges edges = rupture::edges_of(solution);
  const bool stressed_left = solution.left.psi >= solution.right.psi;
  const double fast = stressed_left ? edges.left : edges.right, slow = stressed_left ? edges.right : edges.left;
  const double peak = peak_of(solution, edges), level = threshold * speed(solution, peak);
  return {.fast = fast,
          .slow = slow,
          .peak = peak,
          .peak_velocity = velocity(solution, peak),
          .fast_observed = passes(solution, fast, peak, level),
          .slow_observed = passes(solution, slow, peak, level)};
}

/// The energies without friction and forcing. Nothing is dissipated or supplied; the other energies are not computed.
output::Energy energy_without_forces() {
  return {.elastic = none,
          .kinetic = none,
          .dissipated = 0,
          .supplied = 0,
          .through_ends = none,
          .shocks = none,
          .residual = none,
          .phonons = none};
}

/// The averages at x. At t = 0 they are those of the given sides.
rupture::TrainsPoint point_at(const TrainsSolution& solution, double x, double time) {
  if (time > 0) return rupture::profile_point(solution, x / time);
  const State& side = x < 0 ? solution.left : solution.right;
  return rupture::profile_point(side.empty() ? rupture::FilledBands{} : rupture::bands_of_train(side));
}

output::Snapshot snapshot_of(const TrainsSolution& solution, const Rays& rays, const output::Schedule& schedule,
                             double time) {
  output::Snapshot s{};
  s.time = time;
  for (std::size_t i = 0; i + 1 < schedule.x_edges.size(); ++i) {
    const rupture::TrainsPoint here = point_at(solution, (schedule.x_edges[i] + schedule.x_edges[i + 1]) / 2, time);
    s.profile.k.push_back(here.all.Sigma);
    s.profile.U.push_back(here.all.U);
    s.profile.W.push_back(here.all.W);
    s.profile.H.push_back(here.H);
    s.profile.slip.push_back(time * here.slip);
  }
  s.energy = energy_without_forces();
  s.fronts = {.trailing = time * rays.fast,
              .leading = time * rays.slow,
              .trailing_characteristic = time * rays.fast,
              .trailing_observed = none,
              .leading_observed = none};
  const rupture::TrainsPoint origin = point_at(solution, 0, time);
  s.slip_velocity_at_origin = origin.all.W;
  s.stress_at_origin = origin.all.Sigma;
  s.slip_at_origin = time * origin.slip;
  output::complete(s, schedule);
  s.peak_position = none;
  if (time > 0) {
    s.peak_slip_velocity = rays.peak_velocity;
    s.peak_position = time * rays.peak;
    s.fronts.trailing_observed = time * rays.fast_observed;
    s.fronts.leading_observed = time * rays.slow_observed;
  }
  return s;
}

}  // namespace

std::optional<ComparedModel> closed_form(const scenario::Scenario& s, const output::Schedule& schedule) {
  if (!s.initial.jumps || s.friction.acts() || s.forcing_at || s.contact_at) return {};
  if (s.initial.stress_left == s.initial.stress_right) return {};  // nothing moves, so there is no wave to compare
  const TrainsSolution solution =
      rupture::solve_trains(train::at_rest(s.initial.stress_left), train::at_rest(s.initial.stress_right));
  const Edges edges = rupture::edges_of(solution);
  if (schedule.x_edges.front() > s.end * edges.left || schedule.x_edges.back() < s.end * edges.right) return {};
  const Rays rays = rays_of(solution, schedule.threshold);
  ComparedModel level{.name = "closed-form"};
  for (const double time : schedule.times) level.snapshots.push_back(snapshot_of(solution, rays, schedule, time));
  return level;
}

}  // namespace slipfront::run
