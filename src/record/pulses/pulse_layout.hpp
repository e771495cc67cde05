#pragma once
/// \file
/// What writing and reading a pulse file must agree on, besides its variables.

#include <cstdio>
#include <string>
#include <vector>

#include "record/files/fnv.hpp"
#include "record/pulses/pulse_file.hpp"
#include "record/pulses/pulse_variables.hpp"

namespace slipfront::record::layout {

inline constexpr const char* scenario_bytes = "scenario_text";  ///< variable; only if no attribute can hold the text
inline constexpr const char* solver_state = "checkpoint";       ///< variable

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
  }
  char text[17];
  std::snprintf(text, sizeof text, "%016llx", static_cast<unsigned long long>(fnv.sum()));
  return text;
}

}  // namespace slipfront::record::layout
