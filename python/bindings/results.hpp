#pragma once
/// \file
/// Results of runs as arrays, each with what the NetCDF files say of it.

#include <string>
#include <vector>

#include "bindings.hpp"
#include "record/pulses/pulse_file.hpp"
#include "run/run.hpp"
#include "slipfront/scenario/scenario.hpp"

/// A run that Python asks for.
struct RunRequest {
  std::string text, path;        ///< of the scenario: its text, or (if there is a path) where it lies
  std::vector<std::string> set;  ///< "table.key=value"
  std::string output, resume;    ///< empty: none
  py::object progress;
};
RunRequest request_of(const py::dict& arguments);

slipfront::scenario::Scenario scenario_of(const RunRequest& request);

/// Where a run writes to.
slipfront::record::Output output_of(const RunRequest& request);

/// One series of snapshots a level of theory.
using Levels = std::vector<const std::vector<slipfront::output::Snapshot>*>;

/// A dict {attributes, axes, fields, scalars, warnings} for the pure-Python half; arrays have a dimension "level" in
/// front if `by_level`.
/// Warnings are those of the metadata.
py::dict dataset_of(const slipfront::record::PulseMetadata& metadata, const std::string& format, bool finished,
                    const std::vector<double>& times, const Levels& levels, bool by_level);

py::dict summary_of(const std::vector<slipfront::run::SummaryValue>& summary);
/// What is known of the errors of a summary's numbers; empty `errors`: of none.
py::dict errors_of(const std::vector<slipfront::run::SummaryValue>& summary, const std::vector<double>& errors);

/// That of a run of pulse or chain, with its summary.
template <class Run>
py::dict dataset_of(const slipfront::run::Result<Run>& result) {
  py::dict data = dataset_of(result.metadata, slipfront::record::pulse_format, result.finished(),
                             result.run->schedule().times, {&result.run->snapshots()}, false);
  data["summary"] = summary_of(result.summary);
  return data;
}
