#pragma once

#include <string>
#include <string_view>

namespace slipfront {

bool is_utf8(std::string_view text);

/// Reads bytes as Latin-1, with the dashes and quotation marks of Windows-1252, and returns UTF-8.
std::string from_latin1(std::string_view text);

}  // namespace slipfront
