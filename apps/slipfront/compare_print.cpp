#include "compare_print.hpp"

#include <array>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "batch.hpp"
#include "json.hpp"
#include "long_run.hpp"
#include "terminal_table.hpp"

using namespace slipfront;

namespace {

using output::Scalar;
using CompareUnits = std::optional<medium::SiUnits>;

/// A unit of the model in the units of the results.
medium::UnitInSi unit_in(const CompareUnits& units, const Description& about) {
  return units ? units->of(about.dimensional_unit) : medium::UnitInSi{};
}

double last(const run::ComparedModel& level, const Scalar& number, const CompareUnits& units) {
  return number.get(level.snapshots.back()) * unit_in(units, number.about).value;
}

/// The numbers that describe a level.
std::vector<std::pair<Description, std::optional<double>>> settings_of(const run::ComparedModel& level) {
  return {{output::slip_window, level.number(output::slip_window)},
          {output::velocity_window, level.number(output::velocity_window)},
          {output::wall_time, level.wall_seconds}};
}

Json json_level(const run::ComparedModel& level, const run::ComparedModel* reference, const CompareUnits& units) {
  Json j = {{"level", level.name},
            {"closure", level.closure.empty() ? Json() : Json(level.closure)},
            {"scale", json_of(level.scale)}};
  for (const Scalar& number : output::scalars()) j[std::string(number.about.name)] = last(level, number, units);
  for (auto [about, value] : settings_of(level)) {
    if (value) *value *= unit_in(units, about).value;
    j[std::string(about.name)] = json_of(value);
  }
  for (const Scalar& q : run::compared_numbers())
    j["difference"][std::string(q.about.name)] =
        reference ? Json(last(level, q, units) - last(*reference, q, units)) : Json();
  return j;
}

/// The names of the units in SI of all numbers of a level.
Json names_of_units(const CompareUnits& units, const run::ComparedModel& level) {
  Json names;
  const auto add = [&](const Description& about) {
    if (!about.dimensional_unit.empty()) names[std::string(about.name)] = unit_in(units, about).name;
  };
  add(output::end_time);
  for (const Scalar& number : output::scalars()) add(number.about);
  for (const auto& [about, value] : settings_of(level)) add(about);
  return names;
}

void print_json(const scenario::Scenario& s, const std::vector<run::ComparedModel>& levels) {
  const std::optional<double> C = s.friction.linear_coefficient();
  const CompareUnits& units = s.results_in;
  Json j = {{"time", s.end * unit_in(units, output::end_time).value},
            {"friction_coefficient", json_of(C)},
            {"damping_number", C ? Json(*C * s.end) : Json()},
            {"reference", "pulse-consistent"},
            {"levels", Json::array()}};
  for (const run::ComparedModel& level : levels)
    j["levels"].push_back(json_level(level, run::reference_level(levels), units));
  for (const Scalar& q : run::compared_numbers()) {
    const run::Trend t = run::trend_of(levels, q);
    const double unit = unit_in(units, q.about).value;
    j["trend"][std::string(q.about.name)] = {
        {"exponent", t.exponent}, {"extrapolated", t.extrapolated * unit}, {"difference", t.difference * unit}};
  }
  if (units) {
    j["unit_system"] = "SI";
    j["units"] = names_of_units(units, levels.front());
  }
  j["notes"] = run::notes_on(s, levels);
  put(text_of(j) + "\n");
}

/// Gamma belongs to viscous friction; other laws have their parameters.
std::string friction_in_words(const friction::Friction& f, double time) {
  if (const auto C = f.linear_coefficient()) return fmt::format("C = {:.6g}, Gamma = C t = {:.6g}", *C, *C * time);
  return parameters_in_words(f);
}

std::string cell(double value) { return std::isfinite(value) ? fmt::format("{:.5g}", value) : "-"; }

/// Slip and slip velocities differ by a share of the reference, fronts by a length.
bool is_front(const Scalar& q) { return q.about.dimensional_unit == "b / A"; }

std::string difference_cell(double difference, double theory, const Scalar& q, const CompareUnits& units) {
  if (is_front(q) && units) return std::isfinite(difference) ? fmt::format("{:+.3g}", difference) : cell(difference);
  if (is_front(q)) return std::isfinite(difference) ? fmt::format("{:+.5f}", difference) : cell(difference);
  const double percent = 100 * difference / theory;
  return std::isfinite(percent) ? fmt::format("{:+.3f} %", percent) : cell(percent);
}

constexpr std::array<TableColumn, 8> compare_columns = {{{18, true},
                                                         {13, false, 0},
                                                         {13, false, 0},
                                                         {13, false, 0},
                                                         {13, false, 0},
                                                         {13, false, 0},
                                                         {13, false, 0},
                                                         {10, false, 0}}};

using Cells = std::vector<std::string>;

/// Adds a row with one cell for each quantity.
template <class Cell>
void add_row(TerminalTable& table, const std::string& name, Cell&& cell) {
  Cells cells = {name};
  for (const Scalar& q : run::compared_numbers()) cells.push_back(cell(q));
  table.add(std::move(cells));
}

void add_levels(TerminalTable& table, const std::vector<run::ComparedModel>& levels, const CompareUnits& units) {
  Cells head = {"at the end"};
  for (const Scalar& q : run::compared_numbers()) head.emplace_back(q.heading);
  head.emplace_back("seconds");
  table.add(std::move(head));
  add_row(table, "", [&](const Scalar& q) {
    return units ? unit_in(units, q.about).name : std::string(q.about.dimensional_unit);
  });
  for (const run::ComparedModel& level : levels) {
    Cells cells = {level.name};
    for (const Scalar& q : run::compared_numbers()) cells.push_back(cell(last(level, q, units)));
    cells.push_back(fmt::format("{:.2g}", level.wall_seconds));
    table.add(std::move(cells));
  }
}

void add_differences(TerminalTable& table, const std::vector<run::ComparedModel>& levels,
                     const run::ComparedModel& reference, const CompareUnits& units) {
  const auto theory = [&](const Scalar& q) { return last(reference, q, units); };
  const auto unit = [&](const Scalar& q) { return unit_in(units, q.about).value; };
  table.add_title("");
  table.add_title("difference from pulse-consistent");
  for (const run::ComparedModel& level : levels)
    if (&level != &reference)
      add_row(table, level.name,
              [&](const Scalar& q) { return difference_cell(last(level, q, units) - theory(q), theory(q), q, units); });
  table.add_title("");
  table.add_title("trend of the chain with scale");
  add_row(table, "falls as s^-p, p =", [&](const Scalar& q) { return cell(run::trend_of(levels, q).exponent); });
  add_row(table, "at infinite scale",
          [&](const Scalar& q) { return cell(run::trend_of(levels, q).extrapolated * unit(q)); });
  add_row(table, "less pulse", [&](const Scalar& q) {
    return difference_cell(run::trend_of(levels, q).difference * unit(q), theory(q), q, units);
  });
}

void print_table(const scenario::Scenario& s, const std::vector<run::ComparedModel>& levels) {
  put(fitted(fmt::format("{}{}t = {}, {}", s.title, s.title.empty() ? "" : ": ", s.in_results(s.end, "b / (c A)"),
                         friction_in_words(s.friction, s.end))));
  put("\n");
  TerminalTable table(compare_columns);
  add_levels(table, levels, s.results_in);
  const run::ComparedModel* reference = run::reference_level(levels);
  if (reference) add_differences(table, levels, *reference, s.results_in);
  put(table.text());
  if (!reference) return;
  put("\n");
  for (const std::string& note : run::notes_on(s, levels)) put(fitted(note, 2));
}

}  // namespace

void print_comparison(const scenario::Scenario& s, const std::vector<run::ComparedModel>& levels, bool json) {
  json ? print_json(s, levels) : print_table(s, levels);
}
