#pragma once
/// \file
/// Results of runs as arrays, each with the description that the NetCDF files give it.

#include <string>
#include <vector>

#include "bindings.hpp"
#include "record/pulses/pulse_file.hpp"
#include "run/run.hpp"
#include "slipfront/scenario/scenario.hpp"

/// A run, as the Python part requests it.
struct RunRequest {
  std::string text, path;        ///< the scenario: its file if `path` is not empty, else its TOML text
  std::vector<std::string> set;  ///< settings, each "table.key=value"
  std::string output, resume;    ///< names of files; empty if there is none
  py::object progress;
};
RunRequest request_of(const py::dict& arguments);

slipfront::scenario::Scenario scenario_of(const RunRequest& request);

/// One series of snapshots for each level of theory.
using Levels = std::vector<const std::vector<slipfront::output::Snapshot>*>;

/// Returns a dict {attributes, axes, fields, scalars, warnings} for the Python part, and `events` if there are any. If
/// `by_level` is true, "level" is the first dimension of the arrays. The warnings are those of the metadata.
py::dict dataset_of(const slipfront::record::PulseMetadata& metadata, const std::string& format, bool finished,
                    const std::vector<double>& times, const Levels& levels, bool by_level);

/// Returns {key: value} of each row.
py::dict summary_of(const std::vector<slipfront::run::SummaryValue>& summary);
/// Returns {key: estimated error} of each row whose error is known. `errors` has one number a row, or is empty.
py::dict errors_of(const std::vector<slipfront::run::SummaryValue>& summary, const std::vector<double>& errors);

/// Returns the dict of a run of pulse or chain, with its summary.
template <class Run>
py::dict dataset_of(const slipfront::run::Result<Run>& result) {
  py::dict data = dataset_of(result.metadata, slipfront::record::pulse_format, result.finished(),
                             result.run->schedule().times, {&result.run->snapshots()}, false);
  data["summary"] = summary_of(result.summary);
  return data;
}
