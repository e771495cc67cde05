#include "results.hpp"

#include <pybind11/stl.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>
#include <variant>

#include "record/files/text_file.hpp"
#include "record/files/unfinished.hpp"
#include "record/pulses/pulse_variables.hpp"
#include "run/tables.hpp"

using namespace slipfront;
using output::Snapshot;

RunRequest request_of(const py::dict& arguments) {
  const auto text = [&](const char* key) { return arguments[key].cast<std::string>(); };
  if (const std::string output = text("output"); !output.empty()) record::require_netcdf_name(output, "output");
  return {text("text"),         text("path"),   arguments["set"].cast<std::vector<std::string>>(),
          text("output"),       text("resume"), arguments["si"].cast<std::optional<bool>>(),
          arguments["progress"]};
}

namespace {

/// The unit of a variable in SI units as (value, name, whether it is of slip between the faces).
py::tuple si_tuple(const medium::UnitInSi& unit) { return py::make_tuple(unit.value, unit.name, unit.between_faces); }

/// Reads a table without the GIL: it may wait for a thread that reads NetCDF in Python.
std::vector<std::vector<double>> read_table(const std::string& path, const std::vector<std::string>& columns) {
  if (!PyGILState_Check()) return run::read_table(path, columns);
  const py::gil_scoped_release others_may_run;
  return run::read_table(path, columns);
}

}  // namespace

py::object time_unit_of(const scenario::Scenario& scenario) {
  if (!scenario.in_si || !scenario.results_in) return py::none();
  return py::float_(scenario.results_in->of("b / (c A)").value);
}

scenario::Scenario scenario_of(const RunRequest& request) {
  const bool is_file = !request.path.empty();
  scenario::Scenario s = scenario::read_scenario(is_file ? record::read_text(request.path) : request.text,
                                                 is_file ? request.path : "scenario", request.set, read_table);
  run::require_inputs_kept(s, request.output);
  run::choose_units(s, request.si);
  return s;
}

namespace {

using Shape = std::vector<py::ssize_t>;

py::array_t<double> array(const std::vector<double>& values) {
  return py::array_t<double>(static_cast<py::ssize_t>(values.size()), values.data());
}

py::array_t<double> field(const record::FieldVariable& variable, const Levels& levels, const Shape& shape) {
  py::array_t<double> values(shape);
  double* out = values.mutable_data();
  for (const auto* level : levels)
    for (const Snapshot& snapshot : *level) {
      const std::vector<double> row = variable.of(snapshot, level->front());
      out = std::copy(row.begin(), row.end(), out);
    }
  return values;
}

py::array_t<double> scalar(const output::Scalar& variable, const Levels& levels, const Shape& shape) {
  py::array_t<double> values(shape);
  double* out = values.mutable_data();
  for (const auto* level : levels)
    for (const Snapshot& snapshot : *level) *out++ = variable.get(snapshot);
  return values;
}

py::dict axes(const std::vector<double>& times, const std::vector<double>& edges) {
  const auto cells = static_cast<py::ssize_t>(edges.size()) - 1;
  py::array_t<double> x(cells), bounds(Shape{cells, 2});
  double *centre = x.mutable_data(), *end = bounds.mutable_data();
  for (std::size_t i = 0; i + 1 < edges.size(); ++i) {
    *centre++ = std::midpoint(edges[i], edges[i + 1]);
    *end++ = edges[i];
    *end++ = edges[i + 1];
  }
  const record::AxisVariables& about = record::axis_variables();
  py::dict result;
  result["time"] = py::make_tuple(described(about.time), array(times));
  result["x"] = py::make_tuple(described(about.x), x);
  result["x_bounds"] = py::make_tuple(described(about.x_bounds), bounds);
  return result;
}

/// The variables of the slip events.
py::list events_of(const record::PulseMetadata& metadata, Describer& described_in) {
  py::list events;
  for (const output::SlipEventColumn& column : output::slip_event_columns()) {
    std::vector<double> values;
    for (const output::SlipEvent& event : metadata.events) values.push_back(event.*column.value);
    events.append(py::make_tuple("event_" + std::string(column.about.name),
                                 described_in(output::description_of(column, metadata.pulled_end)), array(values)));
  }
  return events;
}

/// The positions, and the variables over event and position.
py::tuple fronts_of(const output::FrontRecords& fronts, Describer& described_in) {
  const auto events = static_cast<py::ssize_t>(fronts.events.size()),
             positions = static_cast<py::ssize_t>(fronts.x.size());
  py::list columns;
  for (const output::FrontColumn& column : output::front_columns()) {
    py::array_t<double> values(Shape{events, positions});
    double* out = values.mutable_data();
    for (const output::FrontRecord& event : fronts.events)
      out = std::copy((event.*column.values).begin(), (event.*column.values).end(), out);
    columns.append(py::make_tuple(described_in(column.about), values));
  }
  return py::make_tuple(described_in(output::front_position), array(fronts.x), columns);
}

}  // namespace

py::dict attributes_of(const record::PulseMetadata& metadata, const std::string& format, bool finished) {
  py::dict attributes;
  for (const auto& [name, value] : record::file_attributes(metadata, format))
    attributes[py::str(name)] = py::str(py::bytes(value).attr("decode")("utf-8", "replace"));
  attributes["finished"] = finished ? 1 : 0;
  return attributes;
}

py::tuple Describer::operator()(const Description& about) {
  const std::string unit(about.dimensional_unit);
  if (si_ && !unit.empty()) units_[py::str(unit)] = si_tuple(si_->of(unit));
  return described(about);
}

py::dict dataset_of(const record::PulseMetadata& metadata, const std::string& format, bool finished,
                    const std::vector<double>& times, const Levels& levels, bool by_level) {
  Shape over_time, over_time_and_x;
  if (by_level) over_time.push_back(static_cast<py::ssize_t>(levels.size()));
  over_time.push_back(static_cast<py::ssize_t>(times.size()));
  over_time_and_x = over_time;
  over_time_and_x.push_back(static_cast<py::ssize_t>(metadata.x_edges.size()) - 1);

  Describer described_in(metadata.units);
  py::list fields, scalars;
  for (const record::FieldVariable* variable : record::chosen_fields(metadata.variables))
    fields.append(py::make_tuple(described_in(variable->about), field(*variable, levels, over_time_and_x)));
  for (const output::Scalar& variable : output::scalars())
    scalars.append(py::make_tuple(described_in(variable.about), scalar(variable, levels, over_time)));
  py::dict result;
  result["attributes"] = attributes_of(metadata, format, finished);
  result["axes"] = axes(times, metadata.x_edges);
  result["fields"] = fields;
  result["scalars"] = scalars;
  result["warnings"] = py::cast(metadata.warnings);
  if (!metadata.events.empty()) result["events"] = events_of(metadata, described_in);
  if (!metadata.fronts.events.empty()) result["fronts"] = fronts_of(metadata.fronts, described_in);
  const record::AxisVariables& axis = record::axis_variables();
  for (const Description& about : {axis.time, axis.x}) described_in(about);
  result["units"] = described_in.units();
  return result;
}

void add_rows(py::dict& data, std::vector<run::Row> rows, const std::optional<medium::SiUnits>& units) {
  if (units) run::convert(rows, *units);
  py::dict summary, errors;
  for (const run::Row& row : rows) {
    const std::string name(row.about.name);
    summary[py::str(name)] = py::cast(row.value);
    if (!row.reason().empty()) summary[py::str(name + "_reason")] = std::string(row.reason());
    const bool known = !row.errors.empty() &&
                       std::all_of(row.errors.begin(), row.errors.end(), [](double e) { return std::isfinite(e); });
    if (!known) continue;
    const bool is_list = std::holds_alternative<std::vector<double>>(row.value);
    errors[py::str(name)] = is_list ? py::cast(row.errors) : py::cast(row.errors.front());
  }
  data["summary"] = summary;
  data["errors"] = errors;
}
