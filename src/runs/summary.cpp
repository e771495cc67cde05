#include "runs/summary.hpp"

#include <cmath>
#include <utility>

#include "math/constants.hpp"

namespace slipfront::run {
namespace {

using output::MeasuredBy;
using output::Scalar;

/// Whether runs of a solver have this number.
bool is_of(const Scalar& scalar, MeasuredBy solver) { return scalar.by == MeasuredBy::all || scalar.by == solver; }

/// Adds the numbers of a whole run.
template <class Report>
void add_numbers(const Report& report, std::span<const output::Quantity<Report>> of_run, std::vector<Row>& rows) {
  for (const output::Quantity<Report>& quantity : of_run) {
    rows.emplace_back(quantity.about, quantity.get(report));
    if (quantity.unit) rows.back().unit = quantity.unit(report);
  }
}

template <class Report>
std::vector<Row> all_rows(const Report& report, std::span<const output::Quantity<Report>> of_run, MeasuredBy solver) {
  const output::Snapshot& end = report.run.snapshots().back();
  std::vector<Row> rows = {{output::end_time, end.time}};
  for (const Scalar& scalar : output::scalars())
    if (is_of(scalar, solver)) rows.emplace_back(scalar.about, scalar.get(end));
  add_numbers(report, of_run, rows);
  return rows;
}

template <class Report>
std::vector<NumberOfRun> all_numbers(std::span<const output::Quantity<Report>> of_run, MeasuredBy solver) {
  std::vector<NumberOfRun> numbers = {{output::end_time, false}};
  for (const Scalar& scalar : output::scalars())
    if (is_of(scalar, solver)) numbers.push_back({scalar.about, true});
  for (const output::Quantity<Report>& quantity : of_run)
    if (quantity.kind != output::Kind::text) numbers.push_back({quantity.about, quantity.kind == output::Kind::result});
  return numbers;
}

}  // namespace

Row::Row(const Description& description, Value a_value)
    : about(description), value(std::move(a_value)), unit(description.dimensional_unit) {}

std::string_view Row::key() const { return group.empty() ? about.name : about.name.substr(about.name.find('_') + 1); }

std::string Row::meaning() const {
  std::string text(about.long_name);
  if (between_faces) text += ", between the faces";
  if (!unit.empty()) text += ", in " + unit;
  return text;
}

std::string_view Row::reason() const {
  const double* const number = std::get_if<double>(&value);
  return number && !std::isfinite(*number) ? about.reason : std::string_view{};
}

std::span<const double> Row::reals() const {
  if (const auto* list = std::get_if<std::vector<double>>(&value)) return *list;
  if (const auto* real = std::get_if<double>(&value)) return {real, 1};
  return {};
}

double Row::number() const {
  if (const auto* real = std::get_if<double>(&value)) return *real;
  if (const auto* whole = std::get_if<long>(&value)) return static_cast<double>(*whole);
  return none;
}

std::vector<Row> rows_of(const pulse::Run& run, const output::Spent& spent) {
  return all_rows(pulse::Report{run, spent}, pulse::quantities(), MeasuredBy::pulse);
}

std::vector<Row> rows_of(const chain::Run& run, const output::Spent& spent) {
  const chain::Balance balance = run.balance();
  const chain::Averages averages = run.averages();
  std::vector<Row> rows =
      all_rows(chain::Report{run, balance, averages, spent}, chain::quantities(), MeasuredBy::chain);
  for (Row& row : rows) {
    if (row.about.error == ErrorRule::slip_velocity) row.errors = {averages.velocity_error};
    if (row.about.error == ErrorRule::stress) row.errors = {averages.stress_error};
    if (row.about.error == ErrorRule::peak) row.errors = {averages.peak_error};
  }
  return rows;
}

std::vector<Row> rows_of(const plane::Run& run, const output::Spent& spent) {
  const plane::SeriesRow& end = run.series().back();
  std::vector<Row> rows = {{output::end_time, end.time}};
  for (const plane::SeriesNumber& number : plane::series_numbers()) {
    if (number.about.error == ErrorRule::unknown) continue;
    Row& row = rows.emplace_back(number.about, number.get(end));
    if (row.about.name.starts_with("energy_")) row.group = "energies";
  }
  const std::vector<plane::Point>& probes = run.schedule().probes;
  const plane::Solver& solver = run.solver();
  add_numbers({run, run.maps(), solver.slip(probes), solver.velocity(probes), spent}, plane::quantities(), rows);
  return rows;
}

std::vector<NumberOfRun> numbers_of(std::string_view command) {
  return command == "chain" ? all_numbers(chain::quantities(), MeasuredBy::chain)
                            : all_numbers(pulse::quantities(), MeasuredBy::pulse);
}

void convert(std::vector<Row>& rows, const medium::SiUnits& units) {
  for (Row& row : rows) {
    if (row.unit.empty()) continue;
    const medium::UnitInSi unit = units.of(row.unit);
    if (auto* const number = std::get_if<double>(&row.value)) *number *= unit.value;
    if (auto* const list = std::get_if<std::vector<double>>(&row.value))
      for (double& number : *list) number *= unit.value;
    for (double& error : row.errors) error *= unit.value;
    row.unit = unit.name;
    row.between_faces = unit.between_faces;
  }
}

}  // namespace slipfront::run
