#include "results.hpp"

#include <pybind11/stl.h>

#include <algorithm>
#include <cmath>
#include <utility>
#include <variant>

#include "runs/record/run_file.hpp"
#include "runs/tables.hpp"
#include "system/files/whole_file.hpp"

using namespace slipfront;

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

py::dict attributes_of(const record::RunMetadata& metadata, bool finished) {
  py::dict attributes;
  for (const auto& [name, value] : record::file_attributes(metadata))
    attributes[py::str(name)] = py::str(py::bytes(value).attr("decode")("utf-8", "replace"));
  attributes["finished"] = finished ? 1 : 0;
  return attributes;
}

}  // namespace

py::dict dataset_of(const record::RunMetadata& metadata, bool finished, const std::vector<record::Array>& arrays) {
  py::list variables;
  py::dict units;
  for (const record::Array& array : arrays) {
    std::vector<py::ssize_t> shape;
    py::list dimensions;
    for (const record::Array::Dimension& dimension : array.dimensions) {
      shape.push_back(static_cast<py::ssize_t>(dimension.size));
      dimensions.append(std::string(dimension.name));
    }
    py::dict further;
    for (const auto& [name, value] : array.attributes) further[py::str(std::string(name))] = std::string(value);
    const std::string unit(array.about.dimensional_unit);
    if (metadata.units && !unit.empty()) units[py::str(unit)] = si_tuple(metadata.units->of(unit));
    variables.append(py::make_tuple(described(array.about), py::tuple(dimensions),
                                    py::array_t<double>(shape, array.values().data()), further));
  }
  py::dict result;
  result["attributes"] = attributes_of(metadata, finished);
  result["variables"] = variables;
  result["warnings"] = py::cast(metadata.warnings);
  result["units"] = units;
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
