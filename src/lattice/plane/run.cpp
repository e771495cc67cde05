#include "slipfront/lattice/plane/run.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <utility>

#include "lattice/plane/budget.hpp"
#include "math/constants.hpp"
#include "math/digits.hpp"
#include "math/time_steps.hpp"
#include "slipfront/error.hpp"
#include "slipfront/lattice/plane/quantities.hpp"
#include "slipfront/lattice/plane/source_parameters.hpp"
#include "system/archive.hpp"

namespace slipfront::plane {

void require_steady_contacts(const Problem& problem) {
  if (problem.friction.changes_contacts())
    throw InputError({.key = "friction",
                      .value = std::string(problem.friction.name()),
                      .problem = "on a plane, friction cannot change contacts or pores",
                      .allowed = "a law without these effects"});
}

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

namespace {

using Error = ErrorRule;
using output::Value;

constexpr std::string_view on_a_plane = "Eq. 7, on a plane", energy = "mu b^3 / (2 pi^2 (1 - nu))";

constexpr std::string_view not_ruptured = "the cell has not ruptured";

constexpr MemberArray<Field> of_fields[] = {
    {{"slip", "slip since time 0, mean over the cell", "b / (2 pi)", "Eq. 4"}, &Field::slip},
    {{"slip_velocity", "slip velocity, mean over the cell", "c A / pi", "Eq. 4"}, &Field::velocity},
};

constexpr MemberArray<LinePoints> of_lines[] = {
    {{"line_time", "time of a point of a dislocation line", "b / (c A)", "Eq. 3"}, &LinePoints::time},
    {{"line_number", "number n of the dislocation line: u = (2 n - 1) pi", "", "Eq. 2"}, &LinePoints::number},
    {{"line_x", "x of a point of a dislocation line; NaN after each line", "b / A", "Eq. 3"}, &LinePoints::x},
    {{"line_y", "y of a point of a dislocation line; NaN after each line", "b / A", "Eq. 3"}, &LinePoints::y},
};

constexpr MemberArray<Maps> of_maps[] = {
    {{"rupture_time", "time at which the cell ruptures", "b / (c A)", on_a_plane, not_ruptured}, &Maps::rupture_time},
    {{"rupture_velocity", "velocity of the rupture front, 1 / size of the gradient of the rupture time", "c",
      on_a_plane, "the cell or a neighbour has not ruptured, or all rupture at once"},
     &Maps::rupture_velocity},
    {{"peak_slip_velocity", "largest slip velocity so far", "c A / pi", on_a_plane}, &Maps::peak_slip_velocity},
    {{"rise_time", "rise time so far, slip squared / integral of the slip velocity squared over time", "b / (c A)",
      on_a_plane, "there is no slip"},
     &Maps::rise_time},
    {{"initial_stress", "shear stress at time 0, from the gradient of the mean slip", "mu A / pi", "Eq. 5",
      "the cell has no stress"},
     &Maps::initial_stress},
    {{"final_stress", "shear stress at the last time, from the gradient of the mean slip", "mu A / pi", "Eq. 5",
      "the cell has no stress"},
     &Maps::final_stress},
};

constexpr SeriesNumber of_series[] = {
    {{"series_time", "time of a row of the series", "b / (c A)", on_a_plane},
     [](const SeriesRow& row) { return row.time; }},
    {{"potency", "slip since time 0, integrated over the plane", "b^3 / (2 pi A^2)", on_a_plane, {}, Error::change},
     [](const SeriesRow& row) { return row.potency; }},
    {{"potency_rate", "slip velocity, integrated over the plane", "b^2 c / (2 pi A)", on_a_plane, {}, Error::change},
     [](const SeriesRow& row) { return row.potency_rate; }},
    {{"moment", "seismic moment", "mu b^3 / (2 pi A^2)", on_a_plane, {}, Error::change},
     [](const SeriesRow& row) { return row.potency; }},
    {{"moment_rate", "moment rate", "mu b^2 c / (2 pi A)", on_a_plane},
     [](const SeriesRow& row) { return row.potency_rate; }},
    {{"largest_slip_velocity", "largest slip velocity of the cells at this time", "c A / pi", on_a_plane},
     [](const SeriesRow& row) { return row.peak_slip_velocity; }},
    {{"front", "largest distance of the rupture front from the origin", "b / A", on_a_plane, {}, Error::change},
     [](const SeriesRow& row) { return row.front; }},
    {{"energy_kinetic", "energy less the elastic energy", energy, on_a_plane, {}, Error::change},
     [](const SeriesRow& row) { return row.energies.kinetic; }},
    {{"energy_elastic", "energy of the lines at rest, less that at time 0", energy, on_a_plane, {}, Error::change},
     [](const SeriesRow& row) { return row.energies.elastic; }},
    {{"energy_dissipated", "energy lost to friction since time 0", energy, on_a_plane, {}, Error::change},
     [](const SeriesRow& row) { return row.energies.dissipated; }},
    {{"energy_supplied", "energy supplied by F since time 0", energy, on_a_plane, {}, Error::change},
     [](const SeriesRow& row) { return row.energies.supplied; }},
    {{"energy_vanished", "energy of lines that have shrunk to a point", energy, on_a_plane, {}, Error::change},
     [](const SeriesRow& row) { return row.energies.vanished; }},
    {{"energy_radiated", "energy that has left through absorbing edges", energy, on_a_plane, {}, Error::change},
     [](const SeriesRow& row) { return row.energies.radiated; }},
};

double ruptured_area(const Report& report) {
  const MapGrid grid = grid_of(report.run.solver().problem(), report.run.schedule());
  double cells = 0;
  for (const double time : report.maps.rupture_time) cells += std::isnan(time) ? 0 : 1;
  return cells * grid.dx * grid.dy;
}

/// The time at which the last cell ruptured.
double last_rupture(const Maps& maps) {
  double last = none;
  for (const double time : maps.rupture_time)
    if (!std::isnan(time)) last = std::isnan(last) ? time : std::fmax(last, time);
  return last;
}

constexpr output::Quantity<Report> of_run[] = {
    {{"slip_at_probes", "slip since t = 0 at output.probes", "b / (2 pi)", "Eq. 4", {}, Error::slip},
     [](const Report& e) -> Value { return e.slip_at_probes; }},
    {{"slip_velocity_at_probes", "slip velocity at output.probes", "c A / pi", "Eq. 4", {}, Error::slip_velocity},
     [](const Report& e) -> Value { return e.slip_velocity_at_probes; }},
    {{"peak_slip_velocity", "largest slip velocity of a cell since t = 0", "c A / pi", on_a_plane},
     [](const Report& e) -> Value {
       return *std::max_element(e.maps.peak_slip_velocity.begin(), e.maps.peak_slip_velocity.end());
     }},
    {{"ruptured_area", "area of the cells that have ruptured", "b^2 / A^2", on_a_plane},
     [](const Report& e) -> Value { return ruptured_area(e); }},
    {{"last_rupture_time", "time at which the last of these cells ruptured", "b / (c A)", on_a_plane,
      "no cell has ruptured"},
     [](const Report& e) -> Value { return last_rupture(e.maps); }},
    {{"arrest_radius", "distance at which the front has stopped", "b / A", on_a_plane,
      "the front has moved in the last tenth of the run"},
     [](const Report& e) -> Value { return arrest_radius(e.run.series()); }},
    {{"duration", "time in which the potency grows from 5 to 95 %", "b / (c A)", on_a_plane, "the potency is 0"},
     [](const Report& e) -> Value { return duration(e.run.series()); }},
    {{"corner_frequency", "corner frequency of the moment rate", "c A / b", on_a_plane,
      "the slip has not ended: the moment rate is above 5 % of its largest value"},
     [](const Report& e) -> Value { return corner_frequency(e.run.series()); }},
    {{"stress_drop", "stress drop, mean over the plane, weighted by the size of the slip", "mu A / pi", on_a_plane,
      "no cell has slipped, or a cell has no stress"},
     [](const Report& e) -> Value { return stress_drop(e.maps.initial_stress, e.maps.final_stress, e.maps.slip); }},
    {output::step_count, [](const Report& e) -> Value { return e.run.solver().steps(); }},
    {output::wall_time, [](const Report& e) -> Value { return e.spent.wall; }, output::Kind::of_machine},
};

}  // namespace

const Description frequency_axis = {"frequency", "frequency of the spectrum", "c A / b", on_a_plane};
const Description moment_rate_spectrum = {"moment_rate_spectrum", "amplitude spectrum of the moment rate",
                                          "mu b^3 / (2 pi A^2)", on_a_plane};
const Description x_axis = {"x", "position in the direction of slip, centre of the cell", "b / A", "Eq. 3"};
const Description y_axis = {"y", "position across the direction of slip, centre of the cell", "b / A", "Eq. 3"};

void LinePoints::add(double at, const Line& line, const Point& point) {
  time.push_back(at);
  number.push_back(line.number);
  x.push_back(point.x);
  y.push_back(point.y);
}

LinePoints line_points(const std::vector<Field>& snapshots) {
  LinePoints all;
  for (const Field& snapshot : snapshots)
    for (const Line& line : snapshot.lines) {
      for (const Point& point : line.points) all.add(snapshot.time, line, point);
      all.add(snapshot.time, line, {none, none});
    }
  return all;
}

std::span<const MemberArray<LinePoints>> line_arrays() { return of_lines; }
std::span<const MemberArray<Field>> field_arrays() { return of_fields; }
std::span<const MemberArray<Maps>> map_arrays() { return of_maps; }
std::span<const SeriesNumber> series_numbers() { return of_series; }
std::span<const output::Quantity<Report>> quantities() { return of_run; }

Description description_of(const MemberArray<Maps>& map, const Schedule& schedule) {
  Description about = map.about;
  if (map.values == &Maps::rupture_time && !schedule.rupture_rule.empty()) about.long_name = schedule.rupture_rule;
  return about;
}

}  // namespace slipfront::plane
