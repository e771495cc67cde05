#pragma once
/// \file
/// Results of runs as arrays, each with what the NetCDF files say of it.

#include <string>
#include <vector>

#include "bindings.hpp"
#include "slipfront/record/pulse_file.hpp"
#include "slipfront/scenario/scenario.hpp"
#include "slipfront/setup/summary.hpp"

/// How a run was asked for.
struct Asked {
  std::string text, path;        ///< of the scenario: its text, or (if there is a path) where it lies
  std::vector<std::string> set;  ///< "table.key=value"
  std::string output, resume;    ///< empty: none
  py::object progress;
};
Asked asked(const py::dict& arguments);

slipfront::scenario::Scenario scenario_of(const Asked& asked);

/// The metadata of a file that `command` makes, the same as the command line's.
slipfront::record::PulseMetadata metadata_of(const slipfront::scenario::Scenario& scenario, const std::string& command,
                                             const std::vector<double>& x_edges);

/// One series of snapshots a level of theory.
using Levels = std::vector<const std::vector<slipfront::pulse::Snapshot>*>;

/// A dict {attributes, axes, fields, scalars, warnings} for the pure-Python half; arrays have a dimension "level" in
/// front if `by_level`.
/// Warnings are those of the scenario and of the metadata.
py::dict dataset_of(const slipfront::record::PulseMetadata& metadata, const std::string& format, bool finished,
                    const std::vector<double>& times, const Levels& levels, bool by_level,
                    const slipfront::scenario::Scenario& scenario);

py::dict summary_of(const std::vector<slipfront::setup::SummaryValue>& summary);
