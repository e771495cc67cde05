#pragma once
/// \file
/// The file of a run: NetCDF-4 by the CF-1.10 conventions, with the state from which the run can resume.
/// It has the variables of a run along a line over time and x, one line each; those over time are output::scalars().
/// The file of a comparison has the dimensions level, time and x.

#include <cstddef>
#include <cstdio>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "slipfront/description.hpp"
#include "slipfront/lattice/plane/problem.hpp"
#include "slipfront/text/output/dislocation_paths.hpp"
#include "slipfront/text/output/quantities.hpp"
#include "slipfront/text/output/slip_event.hpp"
#include "slipfront/text/output/snapshot.hpp"
#include "slipfront/theory/medium/si_units.hpp"
#include "system/files/seal.hpp"

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

/// Names and texts of the attributes of a file. `format` is the value of its slipfront_format.
std::vector<std::pair<std::string, std::string>> file_attributes(const RunMetadata& metadata,
                                                                 const std::string& format);
/// The attribute `long_name` of a variable in SI units.
std::string long_name_of(const Description& about, const medium::UnitInSi& unit);
/// The text of the attribute `references` of a variable.
std::string reference_of(const Description& about);

/// A variable over time and x.
struct FieldVariable {
  Description about;
  std::vector<double> output::Profile::*values;
  bool drop = false;        ///< the file holds the first snapshot minus this one
  bool on_request = false;  ///< not every run has it

  /// The values that the file holds for a snapshot.
  std::vector<double> of(const output::Snapshot& snapshot, const output::Snapshot& first) const;
};

std::span<const FieldVariable> field_variables();

/// The variables of field_variables() with these names, or all but those `on_request` if `names` is empty. The stress
/// drop adds the stress from which it is measured, because a run could not resume to the same bits without it. \throws
/// InputError for an unknown name.
std::vector<const FieldVariable*> chosen_fields(const std::vector<std::string>& names);

/// The variable in `written` from which to read `values`, or null.
const FieldVariable* holder(const std::vector<const FieldVariable*>& written,
                            std::vector<double> output::Profile::*values);

/// Every field of a profile, once.
std::span<std::vector<double> output::Profile::*const> profile_fields();

}  // namespace slipfront::record

namespace slipfront::record::layout {

inline constexpr const char* scenario_bytes = "scenario_text";  ///< variable; only if no attribute can hold the text
inline constexpr const char* solver_state = "checkpoint";       ///< variable

/// Variables of a chain, if the scenario asks for them.
inline constexpr Description
    site = {"site", "position of a site of the chain", "b / A", "Eq. 3"},
    displacement = {"displacement",
                    "displacement u of a site over chain.scale; each dislocation is a step of 2 pi of u", "b / (2 pi)",
                    "Eq. 3"},
    dislocation = {"dislocation", "number of a dislocation, from 1, in the order of their first time and position", "",
                   "Eq. 3"},
    dislocation_sign = {"dislocation_sign", "1 if u falls by 2 pi with x, -1 for an antidislocation", "", "Eq. 3"},
    dislocation_position = {"dislocation_position", "position of a dislocation, where u passes pi (modulo 2 pi)",
                            "b / A", "Eq. 3", "the dislocation is not in the chain at this time"},
    dislocation_level = {"dislocation_level", "n, where a dislocation is where u passes (2 n + 1) pi", "", "Eq. 3",
                         "the dislocation is not in the chain at this time"};

/// Checksum of what a checkpoint holds: that reading it gave what was written.
inline std::string checksum(const std::string& scenario, const std::string& state, bool finished,
                            const std::vector<output::Snapshot>& snapshots,
                            const std::vector<const FieldVariable*>& written) {
  Fnv fnv;
  fnv.text(scenario).text(state).number(finished).number(snapshots.size());
  for (const output::Snapshot& snapshot : snapshots) {
    fnv.real(snapshot.time);
    for (const output::Scalar& scalar : output::scalars()) fnv.real(scalar.get(snapshot));
    for (const auto field : profile_fields())
      if (holder(written, field)) fnv.reals(snapshot.profile.*field);
    if (!snapshot.displacement.empty()) fnv.reals(snapshot.displacement);
    for (const output::Dislocation& d : snapshot.dislocations)
      fnv.real(d.x).real(d.sign).real(static_cast<double>(d.level));
  }
  char text[17];
  std::snprintf(text, sizeof text, "%016llx", static_cast<unsigned long long>(fnv.sum()));
  return text;
}

}  // namespace slipfront::record::layout

namespace slipfront::record {

inline constexpr const char* comparison_format = "comparison 1";  ///< value of the attribute slipfront_format

/// The results of one level of theory.
struct ComparedLevel {
  std::string name;
  std::optional<double> scale;  ///< scale of a chain; absent for other levels
  std::vector<output::Snapshot> snapshots;
};

/// Writes `path` completely or not at all. Every level must have a snapshot at each of `times`. \throws FileError (one
/// line: path and reason), InputError for an unknown variable, std::invalid_argument if a snapshot is missing.
void write_comparison(const std::string& path, const RunMetadata& metadata, const std::vector<double>& times,
                      const std::vector<ComparedLevel>& levels, bool finished);

}  // namespace slipfront::record
