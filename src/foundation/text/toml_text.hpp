#pragma once

#include <string>
#include <string_view>

#include "foundation/text/parse_toml.hpp"

namespace slipfront {

/// A TOML value as TOML text. Tables are written inline. Numbers have the shortest form that reads back as the same
/// number. (The formatter of toml++ casts negative doubles to size_t, prints 0.1 with 17 digits and breaks short
/// arrays. It also needs streams, which are a tenth of the explorer's download.)
std::string toml_text(const toml::node& node);

/// A key as TOML text, in quotes if it needs them.
std::string toml_key(std::string_view key);

}  // namespace slipfront
