#pragma once
/// \file
/// Results of runs as arrays, each with the description that the NetCDF files give it.

#include <optional>
#include <string>
#include <vector>

#include "bindings.hpp"
#include "runs/record/arrays.hpp"
#include "runs/record/run_file.hpp"
#include "runs/run.hpp"
#include "slipfront/scenario/scenario.hpp"
#include "system/machine.hpp"

/// A run, as the Python part requests it.
struct RunRequest {
  std::string text, path;        ///< the scenario: its file if `path` is not empty, else its TOML text
  std::vector<std::string> set;  ///< settings, each "table.key=value"
  std::string output, resume;    ///< names of files; empty if there is none
  std::optional<bool> si;        ///< whether results are in SI units; by default as in the scenario
  py::object progress;
  slipfront::Clock::time_point begun = slipfront::Clock::now();
};
RunRequest request_of(const py::dict& arguments);

slipfront::scenario::Scenario scenario_of(const RunRequest& request);

/// The unit of time in s if the scenario is in SI units, where settings need units; else None.
py::object time_unit_of(const slipfront::scenario::Scenario& scenario);

/// Returns a dict {attributes, variables, warnings, units} for the Python part. Each variable is a tuple of
/// description, dimensions, array and further attributes. The warnings are those of the metadata. The arrays are in the
/// units of the model. If results are to be in SI units, `units` has the value of each of them.
py::dict dataset_of(const slipfront::record::RunMetadata& metadata, bool finished,
                    const std::vector<slipfront::record::Array>& arrays);

/// Adds `summary`, {name: value} of each row, and `errors`, {name: error} of each row whose error is known. They are in
/// SI units if there are `units`.
void add_rows(py::dict& data, std::vector<slipfront::run::Row> rows,
              const std::optional<slipfront::medium::SiUnits>& units);
