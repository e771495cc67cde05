#include "slipfront/plane/run.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "foundation/archive.hpp"
#include "foundation/step_budget.hpp"
#include "foundation/text/digits.hpp"
#include "plane/budget.hpp"
#include "slipfront/plane/source_parameters.hpp"

namespace slipfront::plane {

double memory_of_results(const Schedule& schedule) {
  // A snapshot has slip and slip velocity. The maps are those of the file and of the saved state.
  constexpr double fields = 2, maps = 10;
  return static_cast<double>(schedule.nx) * schedule.ny * sizeof(double) *
         (fields * static_cast<double>(schedule.times.size()) + maps);
}
namespace {

double largest_size(const std::vector<double>& values) {
  double largest = 0;
  for (const double value : values) largest = std::fmax(largest, std::fabs(value));
  return largest;
}

/// The row at the present time of a solver, without the peak slip velocity, which needs the cells.
SeriesRow row_at(const Solver& solver, double ratio) {
  const Energies e = solver.energies();
  return {.time = solver.time(),
          .potency = ratio * solver.potency(),
          .potency_rate = ratio * solver.potency_rate(),
          .peak_slip_velocity = 0,
          .front = solver.front(ratio),
          .energies = {.kinetic = ratio * e.kinetic,
                       .elastic = ratio * e.elastic,
                       .dissipated = ratio * e.dissipated,
                       .supplied = ratio * e.supplied,
                       .vanished = ratio * e.vanished,
                       .radiated = ratio * e.radiated}};
}

}  // namespace

Run::Run(std::unique_ptr<Solver> solver, Schedule schedule)
    : solver_(std::move(solver)), schedule_(std::move(schedule)) {
  expected_steps_ = solver_->steps_ahead(schedule_.times.back()).by_waves;
  const auto cells = static_cast<std::size_t>(schedule_.nx) * static_cast<std::size_t>(schedule_.ny);
  seen_.rupture_time.assign(cells, std::numeric_limits<double>::quiet_NaN());
  for (auto* values : {&seen_.peak_slip_velocity, &seen_.velocity_squared, &seen_.last_slip}) values->assign(cells, 0);
}

Run::Run(std::unique_ptr<Solver> solver, Schedule schedule, std::string_view saved, std::vector<Field> snapshots)
    : Run(std::move(solver), std::move(schedule)) {
  snapshots_ = std::move(snapshots);
  restore(*this, saved);
}

/// Strong friction shortens the steps of averages. A run that would take far more steps than waves need ends at once.
void Run::require_steps() const {
  if (expected_steps_ == 0) return;
  const double end = schedule_.times.back();
  const StepBudget budget(expected_steps_, end);
  const long taken = solver_->steps();
  if (taken > 0 && !budget.exhausted(taken)) return;
  const StepsAhead ahead = solver_->steps_ahead(end - solver_->time());
  const bool too_many = taken == 0;
  if (too_many && ahead.in_all <= budget.most()) return;
  throw budget.error(
      solver_->time(), taken,
      ahead.reason + (too_many ? ", so that the run would take " + digits(ahead.in_all, 2) + " steps" : ""),
      "weaker friction, fewer cells or a direct run may help");
}

bool Run::go(const std::function<bool()>& interrupted) {
  while (!finished()) {
    const double snapshot = schedule_.times[snapshots_.size()];
    const double next = seen_.series.empty() ? 0 : schedule_.interval * static_cast<double>(seen_.rows_on_time);
    const double until = std::min(snapshot, next);
    if (until == schedule_.times.back() && before_end_.empty()) {
      std::string solver = solver_->steps_end_on_time() ? slipfront::saved(*solver_) : "";
      Archive::to(before_end_)(solver, seen_);
    }
    require_steps();
    const bool reached = solver_->advance_to(until, [&] {
      require_steps();
      return interrupted && interrupted();
    });
    if (!reached) return false;
    observe(until == snapshot);
  }
  require_energy();
  return true;
}

/// Adds a row to the series. A cell ruptures between two rows, at the time at which a straight line between its slips
/// passes the limit.
void Run::observe(bool snapshot) {
  Field field = solver_->field(schedule_.nx, schedule_.ny);
  SeriesRow row = row_at(*solver_, schedule_.wave_speed_ratio);
  row.peak_slip_velocity = largest_size(field.velocity);
  const double before = seen_.series.empty() ? row.time : seen_.series.back().time, limit = schedule_.rupture_slip;
  const double since = row.time - before;
  for (std::size_t i = 0; i < field.slip.size(); ++i) {
    seen_.peak_slip_velocity[i] = std::fmax(seen_.peak_slip_velocity[i], std::fabs(field.velocity[i]));
    const double was = seen_.last_slip[i], is = field.slip[i];
    if (std::fabs(is) > limit && std::isnan(seen_.rupture_time[i]))
      seen_.rupture_time[i] = before + since * (std::copysign(limit, is) - was) / (is - was);
    if (since > 0) seen_.velocity_squared[i] += (is - was) * (is - was) / since;
  }
  if (row.time >= schedule_.interval * static_cast<double>(seen_.rows_on_time)) ++seen_.rows_on_time;
  if (solver_->problem().nucleation) row.front = farthest_rupture();
  seen_.series.push_back(row);
  seen_.last_slip = field.slip;
  if (!snapshot) return;
  if (schedule_.lines) field.lines = solver_->lines();
  for (Line& line : field.lines)
    for (Point& point : line.points) point.y *= schedule_.wave_speed_ratio;
  snapshots_.push_back(std::move(field));
}

double Run::farthest_rupture() const {
  const Problem& p = solver_->problem();
  const MapGrid grid = grid_of(p, schedule_);
  double farthest = 0;
  for (int j = 0; j < grid.ny; ++j)
    for (int i = 0; i < grid.nx; ++i) {
      if (std::isnan(seen_.rupture_time[grid.at(i, j)])) continue;
      farthest = std::fmax(farthest, std::hypot(p.left + (i + 0.5) * grid.dx,
                                                p.bottom * schedule_.wave_speed_ratio + (j + 0.5) * grid.dy));
    }
  return farthest;
}

Maps Run::maps() const {
  const Problem& p = solver_->problem();
  const MapGrid grid = grid_of(p, schedule_);
  std::vector<double> at_start, now;
  at_start.reserve(seen_.last_slip.size());
  now.reserve(seen_.last_slip.size());
  for (int j = 0; j < grid.ny; ++j)
    for (int i = 0; i < grid.nx; ++i) {
      at_start.push_back(p.slip(p.left + (p.right - p.left) * (i + 0.5) / grid.nx,
                                p.bottom + (p.top - p.bottom) * (j + 0.5) / grid.ny));
      now.push_back(at_start.back() + seen_.last_slip[grid.at(i, j)]);
    }
  return {.rupture_time = seen_.rupture_time,
          .rupture_velocity = rupture_velocity(grid, seen_.rupture_time),
          .peak_slip_velocity = seen_.peak_slip_velocity,
          .rise_time = rise_time(seen_.last_slip, seen_.velocity_squared),
          .initial_stress = stress(grid, at_start),
          .final_stress = stress(grid, now),
          .slip = seen_.last_slip};
}

namespace {

constexpr const char* finer = "more cells, or in a direct run a smaller spacing of sites, are needed";

/// Whether the energy of a run is large enough to compare its parts.
bool has_energy(const Solver& solver, const Budget& budget) {
  const Problem& p = solver.problem();
  return budget.largest > std::fmax(solver.least_energy(), no_energy * (p.right - p.left) * (p.top - p.bottom));
}

}  // namespace

/// A run that has lost nine tenths of the energy has wrong results, unless lines ran into each other.
void Run::require_energy() const {
  constexpr double most = 0.9;
  const Budget budget(seen_.series.back().energies);
  if (solver_->lines_have_met() || !has_energy(*solver_, budget) || budget.missing <= most * budget.largest) return;
  throw NumericsError("t = " + digits(solver_->time()) + ": the balance of energy lacks " + budget.in_words() + ": " +
                      finer + ", or friction is too strong for averages");
}

/// A front that no cell resolves, or energy that the solver has lost, makes the results doubtful.
std::vector<std::string> Run::warnings() const {
  std::vector<std::string> all = solver_->warnings();
  if (seen_.series.empty()) return all;
  constexpr double most = 0.02;
  const Budget budget(seen_.series.back().energies);
  if (!has_energy(*solver_, budget)) return all;
  if (budget.missing > most * budget.largest)
    all.push_back("the balance of energy lacks " + budget.in_words() +
                  ": it is lost where lines run into each other, or " + finer);
  if (budget.missing < -most * budget.largest)
    all.push_back("the balance of energy exceeds what was released by " + budget.in_words() + ": " + finer);
  return all;
}

void Run::Seen::archive(Archive& a) {
  a(rows_on_time, series);
  a.fixed(rupture_time, peak_slip_velocity, velocity_squared, last_slip);
}

void Run::archive(Archive& a) {
  std::string solver;
  if (!a.reads()) solver = slipfront::saved(*solver_);
  double end = schedule_.times.back();
  a(solver, seen_, end, before_end_);
  if (!a.reads()) return;
  if (end != schedule_.times.back() && !before_end_.empty()) {
    while (!snapshots_.empty() && snapshots_.back().time >= end) snapshots_.pop_back();
    std::string earlier;
    Archive::from(before_end_)(earlier, seen_);
    if (!earlier.empty()) solver = std::move(earlier);
    before_end_.clear();
  }
  a.require(snapshots_.size() <= schedule_.times.size());
  for (const Field& field : snapshots_) a.require(field.slip.size() == seen_.last_slip.size());
  restore(*solver_, solver);
}

}  // namespace slipfront::plane
