#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace slipfront::scenario {

/// Returns the "table.key" to which a parser's error in `line` most likely refers, or "" if the text does not show it.
std::string key_near(std::string_view text, std::size_t line);

}  // namespace slipfront::scenario
