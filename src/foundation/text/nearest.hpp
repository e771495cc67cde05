#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace slipfront {

/// Number of letters to add, drop or change (Levenshtein).
std::size_t edit_distance(std::string_view a, std::string_view b);

/// The known name nearest to a mistyped one: "'contact_ratio'" or, when none is near, the whole list. For `allowed`.
std::string nearest_or_all(std::string_view name, const std::vector<std::string_view>& known);

}  // namespace slipfront
