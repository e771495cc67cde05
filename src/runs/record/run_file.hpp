#pragma once
/// \file
/// The file of a run: NetCDF-4 by the CF-1.10 conventions, with the state from which the run can resume.
/// It has the variables of a run along a line over time and x, one line each; those over time are output::scalars().
/// The file of a comparison has the dimensions level, time and x.

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "slipfront/description.hpp"
#include "slipfront/lattice/plane/problem.hpp"
#include "slipfront/text/output/quantities.hpp"
#include "slipfront/text/output/snapshot.hpp"
#include "slipfront/theory/medium/si_units.hpp"

namespace slipfront::record {

/// Values of the attribute slipfront_format. Increase a number when old readers would fail.
inline constexpr const char *pulse_format = "pulse 2", *plane_format = "plane 2", *comparison_format = "comparison 2";

/// The content of the file of a run in addition to its arrays and its state.
struct RunMetadata {
  std::string format;
  std::string title;
  std::string scenario_text;                ///< any bytes; read back unchanged
  std::string version;                      ///< version of slipfront
  std::string command_line;                 ///< stored as the file's history
  std::vector<std::string> variables = {};  ///< names of pulse_variables(); empty: all
  std::vector<std::string> warnings = {};   ///< warnings of the scenario and the finished run, a sentence each
  /// Units of the file; absent: of the model. The numbers in a file are always those of the model, so that a run can
  /// continue with the same bits. In SI units each variable has a `scale_factor` (CF, section 8.1), which readers
  /// apply.
  std::optional<medium::SiUnits> units = {};
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

/// Reads a file by write_run (arrays.hpp) with every bit as it was written. \throws FileError if the file is missing,
/// not by slipfront, not in this format, truncated, damaged, or changed by another program.
Checkpoint read_checkpoint(const std::string& path, const std::string& format = pulse_format);

/// Names and texts of the attributes of a file.
std::vector<std::pair<std::string, std::string>> file_attributes(const RunMetadata& metadata);
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

}  // namespace slipfront::record::layout
