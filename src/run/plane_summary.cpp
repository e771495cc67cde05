#include "run/plane_summary.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "slipfront/plane/source_parameters.hpp"

namespace slipfront::run {
namespace {

constexpr double no_error = std::numeric_limits<double>::quiet_NaN();

PlaneRow one(std::string key, double value, double error, std::string unit, std::string meaning) {
  return {.key = std::move(key),
          .values = {value},
          .errors = {error},
          .unit = std::move(unit),
          .meaning = std::move(meaning)};
}

/// A value that may be absent, with the reason.
PlaneRow maybe(std::string key, double value, std::string unit, std::string meaning, std::string reason) {
  PlaneRow row = one(std::move(key), value, no_error, std::move(unit), std::move(meaning));
  if (std::isnan(value)) row.reason = std::move(reason);
  return row;
}

PlaneRow list(std::string key, std::vector<double> values, std::vector<double> errors, std::string unit,
              std::string meaning) {
  return {.key = std::move(key),
          .values = std::move(values),
          .errors = std::move(errors),
          .unit = std::move(unit),
          .meaning = std::move(meaning),
          .is_list = true};
}

double ruptured_area(const PlaneResult& result, const plane::Maps& maps) {
  const plane::MapGrid grid = plane::grid_of(result.run->solver().problem(), result.run->schedule());
  double cells = 0;
  for (const double time : maps.rupture_time) cells += std::isnan(time) ? 0 : 1;
  return cells * grid.dx * grid.dy;
}

/// The time at which the last cell ruptured.
double last_rupture(const plane::Maps& maps) {
  double last = std::numeric_limits<double>::quiet_NaN();
  for (const double time : maps.rupture_time)
    if (!std::isnan(time)) last = std::isnan(last) ? time : std::fmax(last, time);
  return last;
}

std::vector<PlaneRow> energies_of(const plane::Energies& e, const plane::Energies& error) {
  const std::string unit = "mu b^3 / (2 pi^2 (1 - nu))";
  return {one("kinetic", e.kinetic, error.kinetic, unit, "energy less the elastic energy"),
          one("elastic", e.elastic, error.elastic, unit, "energy of the lines at rest, less that at t = 0"),
          one("dissipated", e.dissipated, error.dissipated, unit, "energy lost to friction since t = 0"),
          one("supplied", e.supplied, error.supplied, unit, "energy supplied by F since t = 0"),
          one("vanished", e.vanished, error.vanished, unit, "energy of lines that have shrunk to a point"),
          one("radiated", e.radiated, error.radiated, unit, "energy that has left through absorbing edges")};
}

std::vector<PlaneRow> rows_of(const PlaneResult& result, const PlaneNumbers& errors, const scenario::Scenario& s) {
  const PlaneNumbers& n = result.numbers;
  const plane::SeriesRow &end = n.end, &error = errors.end;
  const plane::Maps maps = result.run->maps();
  const std::vector<plane::SeriesRow>& series = result.run->series();
  const std::string slip = "b / (2 pi)", velocity = "c A / pi", length = "b / A", time = "b / (c A)";
  std::vector<PlaneRow> rows = {
      one("time", end.time, no_error, time, "end of the run"),
      one("potency", end.potency, error.potency, "b^3 / (2 pi A^2)", "slip since t = 0, integrated over the plane"),
      one("potency_rate", end.potency_rate, error.potency_rate, "b^2 c / (2 pi A)",
          "slip velocity, integrated over the plane"),
      list("slip_at_probes", n.slip_at_probes, errors.slip_at_probes, slip, "slip since t = 0 at output.probes"),
      list("slip_velocity_at_probes", n.slip_velocity_at_probes, errors.slip_velocity_at_probes, velocity,
           "slip velocity at output.probes"),
      one("peak_slip_velocity", *std::max_element(maps.peak_slip_velocity.begin(), maps.peak_slip_velocity.end()),
          no_error, velocity, "largest slip velocity of a cell since t = 0"),
      one("front", end.front, error.front, length, "largest distance of the rupture front from the origin"),
      one("ruptured_area", ruptured_area(result, maps), no_error, "b^2 / A^2", "area of the cells that have ruptured"),
      maybe("last_rupture_time", last_rupture(maps), time, "time at which the last of these cells ruptured",
            "no cell has ruptured"),
      maybe("arrest_radius", plane::arrest_radius(series), length, "distance at which the front has stopped",
            "the front has moved in the last tenth of the run"),
      maybe("duration", plane::duration(series), time, "time in which the potency grows from 5 to 95 %",
            "the potency is 0"),
      maybe("corner_frequency", plane::corner_frequency(series), "c A / b", "of the moment rate",
            "the slip has not ended: the moment rate is above 5 % of its largest value"),
      maybe("stress_drop", plane::stress_drop(maps.initial_stress, maps.final_stress, maps.slip), "mu A / pi",
            "mean over the plane, weighted by the size of the slip", "no cell has slipped, or a cell has no stress"),
  };
  if (s.results_in) rows.push_back(one("moment", end.potency, error.potency, "mu b^3 / (2 pi A^2)", "seismic moment"));
  return rows;
}

std::vector<PlaneRow> counts_of(const PlaneResult& result) {
  PlaneRow steps =
      one("steps", static_cast<double>(result.run->solver().steps()), no_error, "", "number of time steps");
  steps.is_whole = true;
  return {steps, one("wall_seconds", result.wall, no_error, "", "seconds of the whole command")};
}

/// Converts rows to SI units if the results are in them, and adds the unit to the meaning.
void convert(std::vector<PlaneRow>& rows, const scenario::Scenario& s) {
  for (PlaneRow& row : rows) {
    if (row.unit.empty()) continue;
    std::string faces;
    if (s.results_in) {
      const medium::UnitInSi unit = s.results_in->of(row.unit);
      for (auto* numbers : {&row.values, &row.errors})
        for (double& number : *numbers) number *= unit.value;
      if (unit.between_faces) faces = ", between the faces";
      row.unit = unit.name;
    }
    row.meaning += faces + ", in " + row.unit;
  }
}

}  // namespace

PlaneSummary summary_of(const scenario::Scenario& s, const PlaneResult& result, const PlaneNumbers& errors) {
  PlaneSummary all{.rows = rows_of(result, errors, s),
                   .energies = energies_of(result.numbers.end.energies, errors.end.energies),
                   .counts = counts_of(result)};
  for (std::vector<PlaneRow>* part : {&all.rows, &all.energies, &all.counts}) convert(*part, s);
  return all;
}

}  // namespace slipfront::run
