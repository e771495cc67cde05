#pragma once

#include <charconv>
#include <string>

namespace slipfront {

/// A number for a message or a name (std::to_string would show 1e-9 as 0). With 17 digits it reads back the same.
inline std::string digits(double value, int count = 6) {
  char text[32];
  return {text, std::to_chars(text, text + sizeof text, value, std::chars_format::general, count).ptr};
}

/// The shortest decimal form that reads back as the same number.
inline std::string shortest(double value) {
  char text[32];
  return {text, std::to_chars(text, text + sizeof text, value).ptr};
}

}  // namespace slipfront
