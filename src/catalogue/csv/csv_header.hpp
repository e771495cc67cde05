#pragma once

#include <string>
#include <vector>

#include "catalogue/keys.hpp"

namespace slipfront::catalogue {

/// One column of a catalogue: its title and the meaning of its cells.
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
    slip_velocity_is,
    rupture_velocity_is,
    stress_drop_is,
    front_threshold
  };
  Role role = Role::ignored;
  std::string title;         ///< as written in the header
  const Key* key = nullptr;  ///< the quantity of a value, of an end of a range or of a provenance; else null
  std::string unit;          ///< default unit of its cells; if empty, each cell must give its own
};

/// Reads a header cell, such as `rupture_velocity_km_s`, `rupture_velocity [km/s]`, `rv_min_km_day` or `name`. Other
/// titles are free text, and their columns are ignored. A title that nearly names a quantity is an error instead.
/// \throws InputError (key, problem, allowed).
Column parse_column(const std::string& title);

}  // namespace slipfront::catalogue
