#pragma once
/// \file
/// The variables of a run along a line over time and x, one line each. Those over time are output::scalars().

#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "record/runs/run_file.hpp"
#include "slipfront/description.hpp"
#include "slipfront/output/quantities.hpp"
#include "slipfront/output/snapshot.hpp"

namespace slipfront::record {

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
