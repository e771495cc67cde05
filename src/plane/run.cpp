#include "slipfront/plane/run.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <utility>

#include "foundation/bytes.hpp"
#include "plane/budget.hpp"
#include "slipfront/plane/source_parameters.hpp"

namespace slipfront::plane {
namespace {

/// The numbers of a row, in the order in which they are saved.
std::vector<double> numbers_of(const SeriesRow& row) {
  const Energies& e = row.energies;
  return {row.time,   row.potency, row.potency_rate, row.peak_slip_velocity,
          row.front,  e.kinetic,   e.elastic,        e.dissipated,
          e.supplied, e.vanished,  e.radiated};
}

SeriesRow row_of(const std::vector<double>& n) {
  return {.time = n.at(0),
          .potency = n.at(1),
          .potency_rate = n.at(2),
          .peak_slip_velocity = n.at(3),
          .front = n.at(4),
          .energies = {.kinetic = n.at(5),
                       .elastic = n.at(6),
                       .dissipated = n.at(7),
                       .supplied = n.at(8),
                       .vanished = n.at(9),
                       .radiated = n.at(10)}};
}

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
  const auto cells = static_cast<std::size_t>(schedule_.nx) * static_cast<std::size_t>(schedule_.ny);
  rupture_time_.assign(cells, std::numeric_limits<double>::quiet_NaN());
  for (auto* values : {&peak_slip_velocity_, &velocity_squared_, &last_slip_}) values->assign(cells, 0);
}

Run::Run(std::unique_ptr<Solver> solver, Schedule schedule, std::string_view saved, std::vector<Field> snapshots)
    : Run(std::move(solver), std::move(schedule)) {
  snapshots_ = std::move(snapshots);
  restore(saved);
}

bool Run::go(const std::function<bool()>& interrupted) {
  while (!finished()) {
    const double snapshot = schedule_.times[snapshots_.size()];
    const double next = series_.empty() ? 0 : schedule_.interval * static_cast<double>(rows_on_time_);
    const double until = std::min(snapshot, next);
    if (!solver_->advance_to(until, interrupted)) return false;
    observe(until == snapshot);
  }
  return true;
}

/// Adds a row to the series. A cell ruptures between two rows, at the time at which a straight line between its slips
/// passes the limit.
void Run::observe(bool snapshot) {
  Field field = solver_->field(schedule_.nx, schedule_.ny);
  SeriesRow row = row_at(*solver_, schedule_.wave_speed_ratio);
  row.peak_slip_velocity = largest_size(field.velocity);
  const double before = series_.empty() ? row.time : series_.back().time, limit = schedule_.rupture_slip;
  const double since = row.time - before;
  for (std::size_t i = 0; i < field.slip.size(); ++i) {
    peak_slip_velocity_[i] = std::fmax(peak_slip_velocity_[i], std::fabs(field.velocity[i]));
    const double was = last_slip_[i], is = field.slip[i];
    if (std::fabs(is) > limit && std::isnan(rupture_time_[i]))
      rupture_time_[i] = before + since * (std::copysign(limit, is) - was) / (is - was);
    if (since > 0) velocity_squared_[i] += (is - was) * (is - was) / since;
  }
  if (row.time >= schedule_.interval * static_cast<double>(rows_on_time_)) ++rows_on_time_;
  if (solver_->problem().nucleation) row.front = farthest_rupture();
  series_.push_back(row);
  last_slip_ = field.slip;
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
      if (std::isnan(rupture_time_[grid.at(i, j)])) continue;
      farthest = std::fmax(farthest, std::hypot(p.left + (i + 0.5) * grid.dx,
                                                p.bottom * schedule_.wave_speed_ratio + (j + 0.5) * grid.dy));
    }
  return farthest;
}

Maps Run::maps() const {
  const Problem& p = solver_->problem();
  const MapGrid grid = grid_of(p, schedule_);
  std::vector<double> at_start, now;
  at_start.reserve(last_slip_.size());
  now.reserve(last_slip_.size());
  for (int j = 0; j < grid.ny; ++j)
    for (int i = 0; i < grid.nx; ++i) {
      at_start.push_back(p.slip(p.left + (p.right - p.left) * (i + 0.5) / grid.nx,
                                p.bottom + (p.top - p.bottom) * (j + 0.5) / grid.ny));
      now.push_back(at_start.back() + last_slip_[grid.at(i, j)]);
    }
  return {.rupture_time = rupture_time_,
          .rupture_velocity = rupture_velocity(grid, rupture_time_),
          .peak_slip_velocity = peak_slip_velocity_,
          .rise_time = rise_time(last_slip_, velocity_squared_),
          .initial_stress = stress(grid, at_start),
          .final_stress = stress(grid, now),
          .slip = last_slip_};
}

/// A front that no cell resolves, or energy that the solver has lost, makes the results doubtful.
std::vector<std::string> Run::warnings() const {
  std::vector<std::string> all = solver_->warnings();
  if (series_.empty()) return all;
  const Budget budget(series_.back().energies);
  constexpr double most = 0.02;
  const Problem& p = solver_->problem();
  if (budget.largest <= std::fmax(solver_->least_energy(), no_energy * (p.right - p.left) * (p.top - p.bottom)))
    return all;
  const std::string resolution =
      "more cells (plane.loops or plane.cells), or with --direct a smaller chain.spacing, are needed";
  if (budget.missing > most * budget.largest)
    all.push_back("the balance of energy lacks " + budget.in_words() +
                  ": it is lost where lines run into each other, or " + resolution);
  if (budget.missing < -most * budget.largest)
    all.push_back("the balance of energy exceeds what was released by " + budget.in_words() + ": " + resolution);
  return all;
}

std::string Run::saved() const {
  bytes::Writer writer;
  writer.put_text(solver_->saved());
  writer.put(static_cast<std::int64_t>(rows_on_time_));
  writer.put(static_cast<std::uint64_t>(series_.size()));
  for (const SeriesRow& row : series_) writer.put(numbers_of(row));
  for (const auto* values : {&rupture_time_, &peak_slip_velocity_, &velocity_squared_, &last_slip_})
    writer.put(*values);
  return std::move(writer).text();
}

void Run::restore(std::string_view saved) {
  bytes::Reader reader(saved);
  solver_->resume(reader.text());
  rows_on_time_ = static_cast<long>(reader.get<std::int64_t>());
  const auto rows = reader.get<std::uint64_t>();
  const std::size_t cells = last_slip_.size();
  bool fits = snapshots_.size() <= schedule_.times.size();
  for (std::uint64_t i = 0; i < rows; ++i) {
    const std::vector<double> numbers = reader.vector();
    fits = fits && numbers.size() == numbers_of({}).size();
    if (fits) series_.push_back(row_of(numbers));
  }
  for (auto* values : {&rupture_time_, &peak_slip_velocity_, &velocity_squared_, &last_slip_}) {
    *values = reader.vector();
    fits = fits && values->size() == cells;
  }
  for (const Field& field : snapshots_) fits = fits && field.slip.size() == cells;
  reader.end();
  if (!fits)
    throw InputError({.key = "resume",
                      .problem = "the saved state is not that of this run",
                      .allowed = "a file of the same scenario"});
}

}  // namespace slipfront::plane
