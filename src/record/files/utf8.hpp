#pragma once
/// \file
/// Makes text valid for a text attribute: UTF-8 without NUL, and not too long. Other text breaks readers in other
/// languages.

#include <cstddef>
#include <string>
#include <string_view>

namespace slipfront::record {

/// `text` with '?' for each byte that is NUL or not UTF-8, cut between characters to at most `most` bytes.
std::string clean_text(std::string_view text, std::size_t most);

}  // namespace slipfront::record
