#pragma once
/// \file
/// What stands in a pulse file, variable by variable: one line each.

#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "record/pulses/pulse_file.hpp"
#include "slipfront/description.hpp"
#include "slipfront/output/snapshot.hpp"

namespace slipfront::record {

/// The coordinates: time, x, x_bounds (cells by their two ends).
struct AxisVariables {
  Description time, x, x_bounds;
};
const AxisVariables& axis_variables();

/// What a file says of itself, attribute by attribute; `format` is its slipfront_format.
std::vector<std::pair<std::string, std::string>> file_attributes(const PulseMetadata& metadata,
                                                                 const std::string& format);
/// What `references` says of a variable.
std::string reference_of(const Description& about);

/// Over time and x.
struct FieldVariable {
  Description about;
  std::vector<double> output::Profile::*values;
  bool drop = false;  ///< written as the first snapshot less this one

  /// What is written of a snapshot.
  std::vector<double> of(const output::Snapshot& snapshot, const output::Snapshot& first) const;
};

/// Over time.
struct ScalarVariable {
  Description about;
  double (*member)(const output::Snapshot&);  ///< null: one of output::further_scalars()
  void (*set_member)(output::Snapshot&, double);
  bool may_be_absent = false;  ///< NaN where there is none

  double get(const output::Snapshot& snapshot) const;
  void set(output::Snapshot& snapshot, double value) const;
};

std::span<const FieldVariable> field_variables();
std::span<const ScalarVariable> scalar_variables();

/// Those of field_variables() that `names` asks for, all if it names none. The stress drop brings the stress that it is
/// measured from: without that a run could not be resumed to the same bits. \throws InputError for an unknown name.
std::vector<const FieldVariable*> chosen_fields(const std::vector<std::string>& names);

/// The variable in `written` to read `values` from, or null.
const FieldVariable* holder(const std::vector<const FieldVariable*>& written,
                            std::vector<double> output::Profile::*values);

/// Every field of a profile, once.
std::span<std::vector<double> output::Profile::*const> profile_fields();

}  // namespace slipfront::record
