#pragma once

#include <functional>
#include <optional>
#include <string>
#include <utility>

#include "scenario/text/section.hpp"
#include "slipfront/scenario/scenario.hpp"

namespace slipfront::scenario {

/// Initial stress as written, before it is known to be one.
struct RawStress {
  std::function<double(double)> at;
  Complaint where;                                       ///< the key that decides it
  std::optional<std::pair<double, double>> covers = {};  ///< of a table: it is defined here only
};

/// Reads [initial]. \throws InputError for keys that do not fit the profile; what `tables` throws.
RawStress read_initial(const Document& document, const TableReader& tables, Initial& initial);

}  // namespace slipfront::scenario
