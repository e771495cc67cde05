#pragma once

#include <string>
#include <vector>

#include "foundation/text/parse_toml.hpp"

namespace slipfront::scenario {

/// The document as TOML text, with its overrides as comments. A run stores this text, so that the run can be repeated.
std::string serialize(const toml::table& root, const std::vector<std::string>& overrides);

}  // namespace slipfront::scenario
