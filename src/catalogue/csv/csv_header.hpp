#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "catalogue/keys.hpp"

namespace slipfront::catalogue {

/// One column of a catalogue: its title and the meaning of its cells.
struct Column {
  enum class Role {
    unknown,  ///< free text, or a quantity that the reader does not know
    unused,   ///< known, and not needed by the theory: latitude, depth, strike, ...
    quantity,
    error,        ///< standard deviation of a quantity
    error_above,  ///< the part of unequal errors above the value
    error_below,
    range_low,
    range_high,
    provenance,
    name,
    identifier,  ///< names the event if no other column does
    date,
    year,
    month,
    day,
    kind,
    citation,
    note,
    slip_velocity_is,
    rupture_velocity_is,
    stress_drop_is,
    front_threshold
  };
  Role role = Role::unknown;
  std::string title = {};       ///< as written in the header
  const Key* key = nullptr;     ///< the quantity to which the cells belong; else null
  std::string unit = {};        ///< default unit of its cells; if empty, each cell must give its own
  int exponent = 0;             ///< the cells are in 10^exponent units
  double deviations = 1;        ///< an error is this many standard deviations
  bool in_percent = false;      ///< the errors are percentages of the value
  bool is_largest = false;      ///< the title states the largest value on the fault, as in "peak slip velocity"
  bool is_static = false;       ///< the title states a static stress drop
  bool looks_physical = false;  ///< an unknown title has a unit, or a word of a quantity
  std::string assumption = {};  ///< a warning for each event that has a value in this column

  bool is_quantity() const { return role == Role::quantity || role == Role::range_low || role == Role::range_high; }
  bool is_error() const { return role == Role::error || role == Role::error_above || role == Role::error_below; }
};

/// Quantities that only serve to derive others. A second column of one of them, and one without a unit, are not used.
bool is_auxiliary(const Key& key);

/// Reads a header cell, such as `rupture_velocity_km_s`, `Rupture Velocity (km/s)`, `rv_min_km_day`, `slip_err [cm]` or
/// `name`. Titles that it does not understand are unknown. A title that nearly names a quantity, and a quantity with a
/// unit of something else, are errors instead. \throws InputError (key, problem, allowed).
Column parse_column(const std::string& title);

/// Like the function above. A bare error such as "err", "sd" or "+-" belongs to the last of the columns before it.
Column parse_column(const std::string& title, const std::vector<Column>& before);

/// Decides between columns of one quantity. \throws InputError if both give an observed quantity.
void settle_columns(std::vector<Column>& columns);

}  // namespace slipfront::catalogue
