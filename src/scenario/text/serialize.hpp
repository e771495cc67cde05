#pragma once

#include <string>
#include <vector>

#include "foundation/text/parse_toml.hpp"

namespace slipfront::scenario {

/// The document, which to_ascii() has been through, as TOML again, the overrides that made it as comments: what a run
/// must keep to be run again. (The formatter of toml++ casts negative doubles to size_t, prints 0.1 with 17 digits and
/// breaks short arrays.)
std::string serialize(const toml::table& root, const std::vector<std::string>& overrides);

}  // namespace slipfront::scenario
