#pragma once
/// \file
/// What writing and reading the file of a run must agree on, besides its variables.

#include <cstdio>
#include <string>
#include <vector>

#include "record/files/fnv.hpp"
#include "record/runs/run_file.hpp"
#include "record/runs/run_variables.hpp"

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
