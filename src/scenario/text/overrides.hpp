#pragma once

#include <map>
#include <string>
#include <vector>

#include "foundation/text/parse_toml.hpp"

namespace slipfront::scenario {

/// The text after '=' in the last override of each key "table.key".
using Overridden = std::map<std::string, std::string, std::less<>>;

/// Applies each "table.key=value" to `root`, in order. A value that is not TOML counts as a text, so that words and
/// formulas need no quotes inside those of the shell. A title that is not overridden itself gets the suffix
/// " (with table.key=value, ...)". \throws InputError (file "--set") for an invalid override or an unknown table.
Overridden apply_overrides(toml::table& root, const std::vector<std::string>& overrides);

}  // namespace slipfront::scenario
