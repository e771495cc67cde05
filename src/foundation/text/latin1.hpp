#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace slipfront {

bool is_utf8(std::string_view text);

/// Reads bytes as Latin-1, with the dashes and quotation marks of Windows-1252, and returns UTF-8.
std::string from_latin1(std::string_view text);

/// The text in UTF-8, with '\n' at the end of each line. A line that is not UTF-8 is read as Latin-1. Nothing if no
/// change is needed.
std::optional<std::string> lines_in_utf8(std::string_view text);

}  // namespace slipfront
