#include <pybind11/stl.h>

#include <array>
#include <cmath>
#include <optional>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "bindings.hpp"
#include "runs/catalogue.hpp"
#include "slipfront/events/catalogue/read.hpp"
#include "system/files/whole_file.hpp"

/// The observations of events as they were read, before any theory is applied.

namespace {

using namespace slipfront;
using catalogue::MeasuredValue;
using catalogue::Observation;

/// Median and standard deviation of ln x, of a lognormal distribution that is as wide as the measured one. NaN if there
/// is no value. The deviation is 0 for an exact number.
std::pair<double, double> logarithm_of(const std::optional<MeasuredValue>& measured) {
  if (!measured) return {std::nan(""), std::nan("")};
  switch (measured->shape) {
    case MeasuredValue::Shape::lognormal:
      return {std::log(measured->low), std::log(measured->spread)};
    case MeasuredValue::Shape::normal:
      return {std::log(measured->low), measured->spread / measured->low};
    case MeasuredValue::Shape::split:
      return {std::log(measured->low), (measured->spread + measured->spread_below) / 2 / measured->low};
    case MeasuredValue::Shape::range:
      break;
  }
  const double width = std::log(measured->high / measured->low);
  return {std::log(measured->low) + width / 2, width / std::sqrt(12.0)};
}

struct Quantity {
  const char* name;
  std::optional<MeasuredValue> Observation::*member;
};
constexpr std::array<Quantity, 8> observables = {{{"rupture_velocity", &Observation::rupture_velocity_m_s},
                                                  {"slip", &Observation::slip},
                                                  {"rise_time", &Observation::rise_time},
                                                  {"duration", &Observation::duration},
                                                  {"length", &Observation::rupture_length},
                                                  {"width", &Observation::rupture_width},
                                                  {"moment", &Observation::moment},
                                                  {"moment_magnitude", &Observation::moment_magnitude}}};

py::dict row_of(const catalogue::Entry& entry, const medium::Defaults& defaults) {
  const Observation& o = entry.observation;
  py::dict row;
  row["name"] = o.name, row["kind"] = o.kind, row["citation"] = o.citation, row["study"] = o.study,
  row["line"] = o.line;
  row["front_threshold"] = o.front_threshold;
  row["rupture_velocity_is"] = catalogue::name_of(o.rupture_velocity_is);
  for (const Quantity& q : observables) {
    const auto [median, deviation] = logarithm_of(o.*q.member);
    row[q.name] = py::make_tuple(median, deviation);
  }
  std::string error;
  try {
    if (entry.error) throw InputError(*entry.error);
    const medium::Elastic e = medium::elastic(o, defaults);
    row["speed"] = e.speed, row["shear_modulus"] = e.shear_modulus;
  } catch (const InputError& e) {
    error = e.what();
  }
  row["error"] = error;
  return row;
}

using Source = std::tuple<std::string, std::string, bool>;  // as in event.cpp

/// How a table is read by a map: its file, or its text.
catalogue::TableOptions table_options(const std::string& map, const std::string& map_file) {
  if (!map_file.empty()) return {.map = record::read_text(map_file), .map_file = map_file};
  return {.map = map, .map_file = "columns"};
}

/// The fronts of a laboratory table: name, line, error, and the measured quantities. Also the titles of the columns
/// that are not used, and notes.
py::tuple fronts(const std::string& text, const std::string& file, const std::array<std::string, 2>& map,
                 const std::vector<std::string>& required) {
  catalogue::TableOptions options = table_options(map[0], map[1]);
  options.of_fronts = true;
  options.required = required;
  py::list rows;
  const catalogue::TableNotes notes = catalogue::read_csv(
      text, file,
      [&](catalogue::Entry&& entry) {
        const Observation& o = entry.observation;
        rows.append(py::make_tuple(o.name, o.line, entry.error ? one_line(*entry.error) : "", o.shear_stress,
                                   o.normal_stress, o.rupture_velocity_m_s, o.stress_drop));
      },
      options);
  return py::make_tuple(rows, notes.ignored, notes.notes);
}

py::list observations(const std::vector<Source>& sources, const std::array<std::string, 3>& medium,
                      const std::array<std::string, 2>& map) {
  run::CatalogueScenario scenario;
  scenario.table = table_options(map[0], map[1]);
  catalogue::check_column_map(scenario.table);
  for (const auto& [content, name, is_path] : sources)
    scenario.texts.push_back({name, is_path ? record::read_text(name) : content});
  scenario.medium = {medium[0], medium[1], medium[2]};
  const run::CataloguePlan plan = run::plan_catalogue(scenario, 1, false);
  py::list rows;
  for (const catalogue::Entry& entry : plan.entries) rows.append(row_of(entry, plan.defaults));
  return rows;
}

/// Median and deviation of the logarithm of a quantity as texts have it.
std::pair<double, double> measured(const std::string& text, const std::string& dimension, const std::string& unit) {
  const MeasuredValue value = catalogue::parse_measured(text, dimension_named(dimension), unit);
  if (!(value.low > 0)) throw InputError({.value = text, .problem = "not positive", .allowed = "> 0"});
  return logarithm_of(value);
}

}  // namespace

void bind_observations(py::module_& m) {
  m.def("observations", observations, py::arg(), py::arg(), py::arg("map") = std::array<std::string, 2>{});
  m.def("fronts", fronts);
  m.def("measured", measured);
}
