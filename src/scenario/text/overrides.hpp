#pragma once

#include <map>
#include <string>
#include <vector>

#include "foundation/text/parse_toml.hpp"

namespace slipfront::scenario {

/// What stands after '=' in the last override of each key "table.key".
using Overridden = std::map<std::string, std::string, std::less<>>;

/// Puts "table.key=value" into `root`, in order; a value that is not TOML is taken as a text, so that words and
/// formulas need no quotes within the shell's. A title that is not overridden itself goes on with
/// " (with table.key=value, ...)". \throws InputError (file "--set") for what is no override or names an
/// unknown table.
Overridden apply_overrides(toml::table& root, const std::vector<std::string>& overrides);

}  // namespace slipfront::scenario
