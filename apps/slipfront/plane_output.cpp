#include "plane_output.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdlib>
#include <limits>
#include <string_view>
#include <utility>

#include "batch.hpp"
#include "json.hpp"
#include "terminal_table.hpp"

using namespace slipfront;

namespace {

constexpr double no_error = std::numeric_limits<double>::quiet_NaN();

/// A row of the results: one number, or one for each probe.
struct Row {
  std::string key;
  std::vector<double> values;
  std::vector<double> errors;  ///< NaN where it is not known
  std::string_view unit;       ///< unit of the model; empty for a pure number
  std::string meaning;
  bool is_list = false;
  bool is_whole = false;  ///< a count
};

Row one(std::string key, double value, double error, std::string_view unit, std::string meaning) {
  return {.key = std::move(key), .values = {value}, .errors = {error}, .unit = unit, .meaning = std::move(meaning)};
}

Row list(std::string key, std::vector<double> values, std::vector<double> errors, std::string_view unit,
         std::string meaning) {
  return {.key = std::move(key),
          .values = std::move(values),
          .errors = std::move(errors),
          .unit = unit,
          .meaning = std::move(meaning),
          .is_list = true};
}

double ruptured_area(const run::PlaneResult& result, const scenario::Plane& plane) {
  const plane::Schedule& schedule = result.run->schedule();
  const plane::Problem& p = plane.problem;
  const double cell = (p.right - p.left) / schedule.nx * (p.top - p.bottom) / schedule.ny * plane.wave_speed_ratio;
  double cells = 0;
  for (const double time : result.run->maps().rupture_time) cells += std::isnan(time) ? 0 : 1;
  return cells * cell;
}

/// The time at which the last cell ruptured.
double last_rupture(const run::PlaneResult& result) {
  double last = std::numeric_limits<double>::quiet_NaN();
  for (const double time : result.run->maps().rupture_time)
    if (!std::isnan(time)) last = std::isnan(last) ? time : std::fmax(last, time);
  return last;
}

std::vector<Row> energies_of(const plane::Energies& e, const plane::Energies& error) {
  constexpr std::string_view unit = "mu b^3 / (2 pi^2 (1 - nu))";
  return {one("kinetic", e.kinetic, error.kinetic, unit, "energy less the elastic energy"),
          one("elastic", e.elastic, error.elastic, unit, "energy of the lines at rest, less that at t = 0"),
          one("dissipated", e.dissipated, error.dissipated, unit, "energy lost to friction since t = 0"),
          one("supplied", e.supplied, error.supplied, unit, "energy supplied by F since t = 0"),
          one("vanished", e.vanished, error.vanished, unit, "energy of lines that have shrunk to a point")};
}

std::vector<Row> rows_of(const run::PlaneResult& result, const run::PlaneNumbers& errors, const scenario::Scenario& s) {
  const run::PlaneNumbers& n = result.numbers;
  const plane::SeriesRow &end = n.end, &error = errors.end;
  const auto& peaks = result.run->maps().peak_slip_velocity;
  constexpr std::string_view slip = "b / (2 pi)", velocity = "c A / pi", length = "b / A", time = "b / (c A)";
  std::vector<Row> rows = {
      one("time", end.time, no_error, time, "end of the run"),
      one("potency", end.potency, error.potency, "b^3 / (2 pi A^2)", "slip since t = 0, integrated over the plane"),
      one("potency_rate", end.potency_rate, error.potency_rate, "b^2 c / (2 pi A)",
          "slip velocity, integrated over the plane"),
      list("slip_at_probes", n.slip_at_probes, errors.slip_at_probes, slip, "slip since t = 0 at output.probes"),
      list("slip_velocity_at_probes", n.slip_velocity_at_probes, errors.slip_velocity_at_probes, velocity,
           "slip velocity at output.probes"),
      one("peak_slip_velocity", *std::max_element(peaks.begin(), peaks.end()), no_error, velocity,
          "largest slip velocity of a cell since t = 0"),
      one("front", end.front, error.front, length, "largest distance of the rupture front from the origin"),
      one("ruptured_area", ruptured_area(result, *s.plane), no_error, "b^2 / A^2",
          "area of the cells that have ruptured"),
      one("last_rupture_time", last_rupture(result), no_error, time, "time at which the last of these cells ruptured"),
  };
  if (s.results_in) rows.push_back(one("moment", end.potency, error.potency, "mu b^3 / (2 pi A^2)", "seismic moment"));
  return rows;
}

std::vector<Row> counts_of(const run::PlaneResult& result) {
  Row steps = one("steps", static_cast<double>(result.run->solver().steps()), no_error, "", "number of time steps");
  steps.is_whole = true;
  return {steps, one("wall_seconds", result.wall, no_error, "", "seconds of the whole command")};
}

/// Converts a row to SI units, and adds its unit to the meaning.
void convert(std::vector<Row>& rows, const scenario::Scenario& s) {
  for (Row& row : rows) {
    if (row.unit.empty()) continue;
    if (!s.results_in) {
      row.meaning += ", in " + std::string(row.unit);
      continue;
    }
    const medium::UnitInSi unit = s.results_in->of(row.unit);
    for (auto* numbers : {&row.values, &row.errors})
      for (double& number : *numbers) number *= unit.value;
    row.meaning += (unit.between_faces ? ", between the faces, in " : ", in ") + unit.name;
  }
}

Json json_of(const Row& row) {
  if (row.is_list) return row.values;
  if (row.is_whole) return static_cast<long>(row.values.front());
  return row.values.front();
}

/// An error with three digits, because it is not known more precisely.
double rounded(double error) {
  return std::isfinite(error) ? std::strtod(fmt::format("{:.3g}", error).c_str(), nullptr) : error;
}

/// The values, errors and units of rows as JSON objects.
struct JsonParts {
  Json values = Json::object(), errors = Json::object(), units = Json::object();

  void add(const std::vector<Row>& rows, const scenario::Scenario& s) {
    for (const Row& row : rows) {
      values[row.key] = json_of(row);
      if (s.results_in && !row.unit.empty()) units[row.key] = s.results_in->of(row.unit).name;
      if (std::none_of(row.errors.begin(), row.errors.end(), [](double e) { return std::isfinite(e); })) continue;
      if (row.is_list)
        for (const double error : row.errors) errors[row.key].push_back(rounded(error));
      else
        errors[row.key] = rounded(row.errors.front());
    }
  }
  void add(const std::string& key, const JsonParts& part) {
    values[key] = part.values;
    errors[key] = part.errors;
    units[key] = part.units;
  }
};

std::string shown(double value) { return std::isfinite(value) ? fmt::format("{}", value) : "null"; }

/// One line a value; the values of probes are numbered.
void print(const std::string& prefix, const std::vector<Row>& rows) {
  for (const Row& row : rows)
    for (std::size_t i = 0; i < row.values.size(); ++i) {
      const std::string key = prefix + row.key + (row.is_list ? fmt::format("[{}]", i) : "");
      const std::string error = std::isfinite(row.errors[i]) ? fmt::format("+- {:.2g}", row.errors[i]) : "";
      put(fitted(fmt::format("{:<26} {:<24} {:<12} {}", key, shown(row.values[i]), error, row.meaning),
                 26 + 1 + 24 + 1 + 12 + 1));
    }
}

}  // namespace

void print_plane(const scenario::Scenario& s, const run::PlaneResult& result, const run::PlaneNumbers& errors,
                 const ScenarioArguments& a) {
  std::vector<Row> rows = rows_of(result, errors, s),
                   energies = energies_of(result.numbers.end.energies, errors.end.energies), counts = counts_of(result);
  for (std::vector<Row>* part : {&rows, &energies, &counts}) convert(*part, s);
  const std::vector<std::string>& warnings = result.metadata.warnings;
  if (!a.common.quiet)
    for (std::size_t i = s.warnings.size(); i < warnings.size(); ++i) complain("warning: " + warnings[i]);
  if (a.common.json) {
    JsonParts all, of_energy;
    of_energy.add(energies, s);
    all.add(rows, s);
    all.add("energies", of_energy);
    all.add(counts, s);
    Json j = all.values;
    j["errors"] = all.errors;
    if (s.results_in) {
      j["unit_system"] = "SI";
      j["units"] = all.units;
    }
    j["warnings"] = warnings;
    put(text_of(j) + "\n");
    return;
  }
  if (!s.title.empty()) put(fitted(s.title));
  print("", rows);
  print("energies.", energies);
  print("", counts);
  const std::string& output = a.output.empty() ? a.resume : a.output;
  if (!output.empty() && !a.common.quiet) put("written to " + output + "\n");
}
