#pragma once

#include <functional>
#include <optional>
#include <string>
#include <utility>

#include "scenario/text/section.hpp"
#include "slipfront/scenario/scenario.hpp"

namespace slipfront::scenario {

/// The initial stress as the user gave it, before any check.
struct RawStress {
  std::function<double(double)> at;
  Complaint where;                                       ///< the key that defines it, for error messages
  std::optional<std::pair<double, double>> covers = {};  ///< for a table: the range in which it defines the stress
};

/// Reads [initial]. \throws InputError for keys that do not fit the profile; what `tables` throws.
RawStress read_initial(const Document& document, const TableReader& tables, Initial& initial);

}  // namespace slipfront::scenario
