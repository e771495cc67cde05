#include "record/planes/plane_variables.hpp"

#include "foundation/math/constants.hpp"

namespace slipfront::record {
namespace {

using plane::SeriesRow;

constexpr std::string_view on_a_plane = "Eq. 7, on a plane", energy = "mu b^3 / (2 pi^2 (1 - nu))";

constexpr PlaneField fields[] = {
    {{"slip", "slip since time 0, mean over the cell", "b / (2 pi)", "Eq. 4"}, &plane::Field::slip},
    {{"slip_velocity", "slip velocity, mean over the cell", "c A / pi", "Eq. 4"}, &plane::Field::velocity},
};

constexpr PlaneLine lines[] = {
    {{"line_time", "time of a point of a dislocation line", "b / (c A)", "Eq. 3"}, &LinePoints::time},
    {{"line_number", "number n of the dislocation line: u = (2 n - 1) pi", "", "Eq. 2"}, &LinePoints::number},
    {{"line_x", "x of a point of a dislocation line; NaN after each line", "b / A", "Eq. 3"}, &LinePoints::x},
    {{"line_y", "y of a point of a dislocation line; NaN after each line", "b / A", "Eq. 3"}, &LinePoints::y},
};

constexpr PlaneMap maps[] = {
    {{"rupture_time", "time at which the cell ruptures", "b / (c A)", on_a_plane}, &plane::Maps::rupture_time},
    {{"rupture_velocity", "velocity of the rupture front, 1 / size of the gradient of the rupture time", "c",
      on_a_plane},
     &plane::Maps::rupture_velocity},
    {{"peak_slip_velocity", "largest slip velocity so far", "c A / pi", on_a_plane}, &plane::Maps::peak_slip_velocity},
    {{"rise_time", "rise time so far, slip squared / integral of the slip velocity squared over time", "b / (c A)",
      on_a_plane},
     &plane::Maps::rise_time},
    {{"initial_stress", "shear stress at time 0, from the gradient of the mean slip", "mu A / pi", "Eq. 5"},
     &plane::Maps::initial_stress},
    {{"final_stress", "shear stress at the last time, from the gradient of the mean slip", "mu A / pi", "Eq. 5"},
     &plane::Maps::final_stress},
};

constexpr PlaneSeries series[] = {
    {{"series_time", "time of a row of the series", "b / (c A)", on_a_plane},
     [](const SeriesRow& row) { return row.time; }},
    {{"potency", "slip since time 0, integrated over the plane", "b^3 / (2 pi A^2)", on_a_plane},
     [](const SeriesRow& row) { return row.potency; }},
    {{"potency_rate", "slip velocity, integrated over the plane", "b^2 c / (2 pi A)", on_a_plane},
     [](const SeriesRow& row) { return row.potency_rate; }},
    {{"moment", "seismic moment", "mu b^3 / (2 pi A^2)", on_a_plane}, [](const SeriesRow& row) { return row.potency; }},
    {{"moment_rate", "moment rate", "mu b^2 c / (2 pi A)", on_a_plane},
     [](const SeriesRow& row) { return row.potency_rate; }},
    {{"largest_slip_velocity", "largest slip velocity of the cells at this time", "c A / pi", on_a_plane},
     [](const SeriesRow& row) { return row.peak_slip_velocity; }},
    {{"front", "largest distance of the rupture front from the origin", "b / A", on_a_plane},
     [](const SeriesRow& row) { return row.front; }},
    {{"energy_kinetic", "energy less the elastic energy", energy, on_a_plane},
     [](const SeriesRow& row) { return row.energies.kinetic; }},
    {{"energy_elastic", "energy of the lines at rest, less that at time 0", energy, on_a_plane},
     [](const SeriesRow& row) { return row.energies.elastic; }},
    {{"energy_dissipated", "energy lost to friction since time 0", energy, on_a_plane},
     [](const SeriesRow& row) { return row.energies.dissipated; }},
    {{"energy_supplied", "energy supplied by F since time 0", energy, on_a_plane},
     [](const SeriesRow& row) { return row.energies.supplied; }},
    {{"energy_vanished", "energy of lines that have shrunk to a point", energy, on_a_plane},
     [](const SeriesRow& row) { return row.energies.vanished; }},
    {{"energy_radiated", "energy that has left through absorbing edges", energy, on_a_plane},
     [](const SeriesRow& row) { return row.energies.radiated; }},
};

}  // namespace

const Description plane_time = {"time", "time", "b / (c A)", "Eq. 3"};
const Description plane_frequency = {"frequency", "frequency of the spectrum", "c A / b", on_a_plane};
const Description plane_spectrum = {"moment_rate_spectrum", "amplitude spectrum of the moment rate",
                                    "mu b^3 / (2 pi A^2)", on_a_plane};
const Description plane_x = {"x", "position in the direction of slip, centre of the cell", "b / A", "Eq. 3"};
const Description plane_y = {"y", "position across the direction of slip, centre of the cell", "b / A", "Eq. 3"};
void LinePoints::add(double at, const plane::Line& line, const plane::Point& point) {
  time.push_back(at);
  number.push_back(line.number);
  x.push_back(point.x);
  y.push_back(point.y);
}

LinePoints line_points(const std::vector<plane::Field>& snapshots) {
  LinePoints all;
  for (const plane::Field& snapshot : snapshots)
    for (const plane::Line& line : snapshot.lines) {
      for (const plane::Point& point : line.points) all.add(snapshot.time, line, point);
      all.add(snapshot.time, line, {none, none});
    }
  return all;
}

std::span<const PlaneLine> plane_lines() { return lines; }
std::span<const PlaneField> plane_fields() { return fields; }
std::span<const PlaneMap> plane_maps() { return maps; }
std::span<const PlaneSeries> plane_series() { return series; }

Description description_of(const PlaneMap& map, const plane::Schedule& schedule) {
  Description about = map.about;
  if (map.values == &plane::Maps::rupture_time && !schedule.rupture_rule.empty())
    about.long_name = schedule.rupture_rule;
  return about;
}

std::string_view plane_unit(std::string_view name) {
  for (const PlaneSeries& row : series)
    if (row.about.name == name) return row.about.dimensional_unit;
  for (const PlaneField& field : fields)
    if (field.about.name == name) return field.about.dimensional_unit;
  for (const PlaneMap& map : maps)
    if (map.about.name == name) return map.about.dimensional_unit;
  return {};
}

}  // namespace slipfront::record
