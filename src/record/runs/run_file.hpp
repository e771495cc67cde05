#pragma once
/// \file
/// The file of a run: NetCDF-4 by the CF-1.10 conventions, with the state from which the run can resume.

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "slipfront/medium/si_units.hpp"
#include "slipfront/output/dislocation_paths.hpp"
#include "slipfront/output/slip_event.hpp"
#include "slipfront/output/snapshot.hpp"
#include "slipfront/plane/problem.hpp"

namespace slipfront::record {

/// Values of the attribute slipfront_format. Increase a number when old readers would fail.
inline constexpr const char *pulse_format = "pulse 1", *plane_format = "plane 2";

/// The content of the file of a run in addition to its snapshots.
struct RunMetadata {
  std::string title;
  std::string scenario_text;               ///< any bytes; read back unchanged
  std::string version;                     ///< version of slipfront
  std::string command_line;                ///< stored as the file's history
  std::vector<double> x_edges;             ///< edges of the cells, ascending: one more than there are cells
  std::vector<std::string> variables;      ///< names of pulse_variables(); empty: all
  std::vector<std::string> warnings = {};  ///< warnings of the scenario and the finished run, a sentence each
  /// Events of a loaded chain so far. The file holds them as variables event_... over the dimension event.
  std::vector<output::SlipEvent> events = {};
  bool pulled_end = false;  ///< springs pull one end; see output::description_of
  /// Units of the file; absent: of the model. The numbers in a file are always those of the model, so that a run can
  /// continue with the same bits. In SI units each variable has a `scale_factor` (CF, section 8.1), which readers
  /// apply.
  std::optional<medium::SiUnits> units = {};
  output::FrontRecords fronts = {};  ///< arrivals of these events, over the dimensions event and position
  std::vector<double> sites = {};    ///< positions of the sites, if the snapshots have their displacement
  output::PathSettings paths = {};   ///< how to number dislocations
};

/// An unfinished or a finished run.
struct Checkpoint {
  std::string scenario_text;
  std::string version;
  std::string solver_state;                      ///< opaque
  std::vector<output::Snapshot> snapshots = {};  ///< profile fields that the file does not hold are empty
  std::vector<plane::Field> fields = {};         ///< snapshots of a plane
  bool finished = false;
};

/// Names of the variables over time and x that a file can hold. Variables over only time are always written.
std::vector<std::string> pulse_variables();

/// Writes `path` completely or not at all; an old file is unchanged if this fails. Equal arguments give files that are
/// equal byte by byte, because a file holds neither date nor host. Times must ascend, and profiles must have as many
/// cells as `x_edges`; fields that are not requested may be empty. `snapshots` may be empty. \throws FileError (one
/// line: path and reason), InputError for an unknown variable, std::invalid_argument for wrong times or profiles.
void write_pulse(const std::string& path, const RunMetadata& metadata, const std::vector<output::Snapshot>& snapshots,
                 const std::string& solver_state, bool finished);

/// Reads a file by write_pulse or, with the format plane_format, of a run on a plane, with every bit as it was written.
/// \throws FileError if the file is missing, not by slipfront, truncated, damaged, or changed by another program.
Checkpoint read_checkpoint(const std::string& path, const std::string& format = pulse_format);

}  // namespace slipfront::record
