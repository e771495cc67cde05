#include "slipfront/plane/quantities.hpp"

#include <algorithm>
#include <cmath>

#include "foundation/math/constants.hpp"
#include "slipfront/plane/source_parameters.hpp"

namespace slipfront::plane {
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
    {output::wall_time, [](const Report& e) -> Value { return e.wall; }, output::Kind::of_machine},
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
