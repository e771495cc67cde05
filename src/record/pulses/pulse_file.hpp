#pragma once
/// \file
/// The file of a pulse run: NetCDF-4 by the CF-1.10 conventions, and the state from which the run can go on.

#include <cstddef>
#include <string>
#include <vector>

#include "slipfront/output/slip_event.hpp"
#include "slipfront/output/snapshot.hpp"

namespace slipfront::record {

/// Attribute slipfront_format; count up when old readers would fail.
inline constexpr const char* pulse_format = "pulse 1";

/// What a pulse file says besides the snapshots.
struct PulseMetadata {
  std::string title;
  std::string scenario_text;                   ///< any bytes; comes back as it was
  std::string version;                         ///< of slipfront
  std::string command_line;                    ///< the file's history
  std::vector<double> x_edges;                 ///< of the cells, ascending: one more than there are cells
  std::vector<std::string> variables;          ///< names of pulse_variables(); empty: all
  std::vector<std::string> warnings = {};      ///< of the scenario and the finished run, a sentence each
  std::vector<output::SlipEvent> events = {};  ///< of a loaded chain so far: variables event_... over dimension event
};

/// A run in progress, or a finished one.
struct Checkpoint {
  std::string scenario_text;
  std::string version;
  std::string solver_state;                 ///< opaque
  std::vector<output::Snapshot> snapshots;  ///< so far. A field of the profiles that the file was not to hold is empty
  bool finished;
};

/// Names of the variables over time and x that a file can hold. Those over time alone are always there.
std::vector<std::string> pulse_variables();

/// Writes `path` whole or not at all; an old file stays as it was when this fails. Equal arguments make equal files,
/// byte by byte: no date, no host. Profiles must have as many cells as `x_edges` (fields that are not asked for may be
/// empty) and times must ascend, or this throws std::invalid_argument. No snapshots are fine. \throws FileError (one
/// line: path and reason), InputError for an unknown variable.
void write_pulse(const std::string& path, const PulseMetadata& metadata, const std::vector<output::Snapshot>& snapshots,
                 const std::string& solver_state, bool finished);

/// Reads back what write_pulse wrote, to the bit. \throws FileError if the file is not there, not of slipfront, cut
/// short, damaged, or changed by another program.
Checkpoint read_checkpoint(const std::string& path);

/// The same, to go on from. \throws InputError if another scenario or version of slipfront wrote it.
Checkpoint read_checkpoint_of(const std::string& path, const std::string& scenario_text, const std::string& version);

}  // namespace slipfront::record
