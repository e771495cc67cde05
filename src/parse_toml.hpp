#pragma once

#define TOML_ASSERT(x) static_cast<void>(0)  // else an escape such as "[\x06" aborts
#include <toml++/toml.h>

#include <string>
#include <string_view>

namespace slipfront {

/// A TOML document. \throws InputError with file and line.
toml::table parse_toml(std::string_view text, const std::string& file);

}  // namespace slipfront
