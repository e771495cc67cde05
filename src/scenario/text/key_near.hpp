#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace slipfront::scenario {

/// "table.key" that a parser's complaint about `line` is most likely about; "" where the text does not tell.
std::string key_near(std::string_view text, std::size_t line);

}  // namespace slipfront::scenario
