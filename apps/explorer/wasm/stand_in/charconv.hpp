#pragma once
/// \file
/// Functions that the C++ library of emscripten 3.1 lacks: std::bit_cast, and conversion of numbers to and from text.
/// The build includes this file before every other file.

#include <charconv>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <cstring>

namespace std {

template <class To, class From>
constexpr To bit_cast(const From& from) noexcept {
  return __builtin_bit_cast(To, from);
}

inline to_chars_result to_chars(char* first, char* last, double value, chars_format, int count) {
  const int length = std::snprintf(first, static_cast<size_t>(last - first), "%.*g", count, value);
  return {first + length, errc{}};
}

/// The shortest form that reads back as the same number, with up to 17 digits. It has an exponent only if that is
/// shorter than the decimal form.
inline to_chars_result to_chars(char* first, char* last, double value) {
  char scientific[32], decimal[64];
  int digits = 1;
  for (; digits < 17; ++digits) {
    std::snprintf(scientific, sizeof scientific, "%.*e", digits - 1, value);
    if (std::isnan(value) || std::strtod(scientific, nullptr) == value) break;
  }
  int length = std::snprintf(scientific, sizeof scientific, "%.*e", digits - 1, value);
  const char* text = scientific;
  const char* const e = std::strchr(scientific, 'e');
  const int exponent = e ? std::atoi(e + 1) : 0;
  if (e && exponent > -20 && exponent < 25) {
    const int decimals = digits - 1 > exponent ? digits - 1 - exponent : 0;
    const int other = std::snprintf(decimal, sizeof decimal, "%.*f", decimals, value);
    if (other <= length) length = other, text = decimal;
  }
  if (length > last - first) return {last, errc::value_too_large};
  std::memcpy(first, text, static_cast<size_t>(length));
  return {first + length, errc{}};
}

/// toml++ refers to this overload, but we never ask it for a hexadecimal number.
inline to_chars_result to_chars(char* first, char* last, double value, chars_format) {
  return to_chars(first, last, value);
}

/// Reads a decimal number like std::from_chars: without a leading blank or plus sign, and not in hexadecimal form.
inline from_chars_result from_chars(const char* first, const char* last, double& value,
                                    chars_format = chars_format::general) {
  char text[512];
  size_t length = 0;
  for (const char* at = first; at < last && length < sizeof text - 1 && std::strchr("+-.0123456789eE", *at); ++at)
    text[length++] = *at;
  text[length] = 0;
  char* end = text;
  const double read = length > 0 && text[0] != '+' ? std::strtod(text, &end) : 0;
  if (end == text) return {first, errc::invalid_argument};
  if (std::isinf(read)) return {first + (end - text), errc::result_out_of_range};
  value = read;
  return {first + (end - text), errc{}};
}

}  // namespace std
