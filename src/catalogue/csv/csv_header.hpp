#pragma once

#include <string>
#include <vector>

#include "catalogue/keys.hpp"

namespace slipfront::catalogue {

/// What one column of a catalogue holds.
struct Column {
  enum class Role {
    ignored,
    quantity,
    range_low,
    range_high,
    provenance,
    name,
    date,
    kind,
    citation,
    note,
    slip_velocity_is
  };
  Role role = Role::ignored;
  std::string title;         ///< as the header has it
  const Key* key = nullptr;  ///< of a quantity, a range end or its provenance
  std::string unit;          ///< default unit of its cells; empty: each cell must carry its own
};

/// Reads a header cell: `rupture_velocity_km_s`, `rupture_velocity [km/s]`, `rv_min_km_day`, `name`, ... A title that
/// is no quantity is free text and ignored, unless it nearly is one. \throws InputError (key, problem, allowed).
Column parse_column(const std::string& title);

}  // namespace slipfront::catalogue
