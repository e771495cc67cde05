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
using namespace slipfront::setup;

namespace {

using CompareUnits = std::optional<medium::SiUnits>;

/// The unit of a key in the units of the results.
medium::UnitInSi unit_of(const CompareUnits& units, std::string_view key) {
  return units ? units->of(run::unit_of(key)) : medium::UnitInSi{};
}

double last(const Level& level, const Quantity& quantity, const CompareUnits& units) {
  return quantity.get(level.snapshots.back()) * unit_of(units, quantity.key).value;
}

Json json_level(const Level& level, const Level* reference, const CompareUnits& units) {
  const output::Snapshot& s = level.snapshots.back();
  Json j = {{"level", level.name},
            {"closure", level.closure.empty() ? Json() : Json(level.closure)},
            {"scale", json_of(level.scale)}};
  const auto add = [&](const char* key, std::optional<double> value) {
    if (value) *value *= unit_of(units, key).value;
    j[key] = json_of(value);
  };
  for (const Quantity& q : compared_quantities()) add(q.key, q.get(s));
  add("stress_at_origin", s.stress_at_origin);
  add("peak_position", s.peak_position);
  add("trailing_front", s.fronts.trailing);
  add("energy_dissipated", s.energy.dissipated);
  add("window", level.window);
  add("smooth_window", level.smooth_window);
  j["wall_seconds"] = level.wall_seconds;
  for (const Quantity& q : compared_quantities())
    j["difference"][q.key] = reference ? Json(last(level, q, units) - last(*reference, q, units)) : Json();
  return j;
}

void print_json(const scenario::Scenario& s, const std::vector<Level>& levels) {
  const std::optional<double> C = s.friction.linear_coefficient();
  const CompareUnits& units = s.results_in;
  Json j = {{"time", s.end * unit_of(units, "time").value},
            {"friction_coefficient", json_of(C)},
            {"damping_number", C ? Json(*C * s.end) : Json()},
            {"reference", "pulse-consistent"},
            {"levels", Json::array()}};
  for (const Level& level : levels) j["levels"].push_back(json_level(level, reference_level(levels), units));
  for (const Quantity& q : compared_quantities()) {
    const Trend t = trend_of(levels, q);
    const double unit = unit_of(units, q.key).value;
    j["trend"][q.key] = {
        {"exponent", t.exponent}, {"extrapolated", t.extrapolated * unit}, {"difference", t.difference * unit}};
  }
  if (units) {
    Json names = {{"time", unit_of(units, "time").name}};
    for (const auto& [key, value] : j["levels"].front().items())
      if (!run::unit_of(key).empty()) names[key] = unit_of(units, key).name;
    j["unit_system"] = "SI";
    j["units"] = names;
  }
  j["notes"] = notes_on(s, levels);
  put(text_of(j) + "\n");
}

/// Gamma belongs to viscous friction; other laws have their parameters.
std::string friction_in_words(const friction::Friction& f, double time) {
  if (const auto C = f.linear_coefficient()) return fmt::format("C = {:.6g}, Gamma = C t = {:.6g}", *C, *C * time);
  return parameters_in_words(f);
}

std::string cell(double value) { return std::isfinite(value) ? fmt::format("{:.5g}", value) : "-"; }

/// Slip and slip velocities differ by a share of the reference, fronts by a length.
bool is_front(const Quantity& q) { return std::string_view(q.key).find("front") != std::string_view::npos; }

std::string difference_cell(double difference, double theory, const Quantity& q, const CompareUnits& units) {
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
  for (const Quantity& q : compared_quantities()) cells.push_back(cell(q));
  table.add(std::move(cells));
}

void add_levels(TerminalTable& table, const std::vector<Level>& levels, const CompareUnits& units) {
  Cells head = {"at the end"};
  for (const Quantity& q : compared_quantities()) head.emplace_back(q.heading);
  head.emplace_back("seconds");
  table.add(std::move(head));
  add_row(table, "",
          [&](const Quantity& q) { return units ? unit_of(units, q.key).name : std::string(run::unit_of(q.key)); });
  for (const Level& level : levels) {
    Cells cells = {level.name};
    for (const Quantity& q : compared_quantities()) cells.push_back(cell(last(level, q, units)));
    cells.push_back(fmt::format("{:.2g}", level.wall_seconds));
    table.add(std::move(cells));
  }
}

void add_differences(TerminalTable& table, const std::vector<Level>& levels, const Level& reference,
                     const CompareUnits& units) {
  const auto theory = [&](const Quantity& q) { return last(reference, q, units); };
  const auto unit = [&](const Quantity& q) { return unit_of(units, q.key).value; };
  table.add_title("");
  table.add_title("difference from pulse-consistent");
  for (const Level& level : levels)
    if (&level != &reference)
      add_row(table, level.name, [&](const Quantity& q) {
        return difference_cell(last(level, q, units) - theory(q), theory(q), q, units);
      });
  table.add_title("");
  table.add_title("trend of the chain with scale");
  add_row(table, "falls as s^-p, p =", [&](const Quantity& q) { return cell(trend_of(levels, q).exponent); });
  add_row(table, "at infinite scale",
          [&](const Quantity& q) { return cell(trend_of(levels, q).extrapolated * unit(q)); });
  add_row(table, "less pulse", [&](const Quantity& q) {
    return difference_cell(trend_of(levels, q).difference * unit(q), theory(q), q, units);
  });
}

void print_table(const scenario::Scenario& s, const std::vector<Level>& levels) {
  put(fitted(fmt::format("{}{}t = {}, {}", s.title, s.title.empty() ? "" : ": ", in_results(s, s.end, "b / (c A)"),
                         friction_in_words(s.friction, s.end))));
  put("\n");
  TerminalTable table(compare_columns);
  add_levels(table, levels, s.results_in);
  const Level* reference = reference_level(levels);
  if (reference) add_differences(table, levels, *reference, s.results_in);
  put(table.text());
  if (!reference) return;
  put("\n");
  for (const std::string& note : notes_on(s, levels)) put(fitted(note, 2));
}

}  // namespace

void print_comparison(const scenario::Scenario& s, const std::vector<Level>& levels, bool json) {
  json ? print_json(s, levels) : print_table(s, levels);
}
