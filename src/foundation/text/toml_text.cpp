#include "foundation/text/toml_text.hpp"

#include <type_traits>

#include "foundation/text/digits.hpp"

namespace slipfront {
namespace {

std::string in_quotes(std::string_view text) {
  constexpr std::string_view hexadecimal = "0123456789ABCDEF";
  std::string out = "\"";
  for (const char c : text) {
    const auto byte = static_cast<unsigned char>(c);
    if (c == '"' || c == '\\') {
      out += '\\';
      out += c;
    } else if (byte < 0x20 || byte == 0x7F) {
      out += "\\u00";
      out += hexadecimal[byte / 16u];
      out += hexadecimal[byte % 16u];
    } else {
      out += c;
    }
  }
  return out + "\"";
}

std::string padded(std::uint64_t number, std::size_t width) {
  const std::string text = std::to_string(number);
  return text.size() < width ? std::string(width - text.size(), '0') + text : text;
}

std::string text_of(const std::string& value) { return in_quotes(value); }

std::string text_of(bool value) { return value ? "true" : "false"; }

std::string text_of(std::int64_t value) { return std::to_string(value); }

std::string text_of(double value) {
  const std::string text = shortest(value);
  return text.find_first_of(".en") == std::string::npos ? text + ".0" : text;  // inf and nan contain an n
}

std::string text_of(const toml::date& date) {
  return padded(date.year, 4) + "-" + padded(date.month, 2) + "-" + padded(date.day, 2);
}

std::string text_of(const toml::time& time) {
  std::string text = padded(time.hour, 2) + ":" + padded(time.minute, 2) + ":" + padded(time.second, 2);
  if (time.nanosecond == 0) return text;
  const std::string fraction = padded(time.nanosecond, 9);
  return text + "." + fraction.substr(0, fraction.find_last_not_of('0') + 1);
}

std::string text_of(const toml::date_time& value) {
  std::string text = text_of(value.date) + "T" + text_of(value.time);
  if (!value.offset) return text;
  const int minutes = value.offset->minutes;
  if (minutes == 0) return text + "Z";
  const auto size = static_cast<std::uint64_t>(minutes < 0 ? -minutes : minutes);
  return text + (minutes < 0 ? "-" : "+") + padded(size / 60, 2) + ":" + padded(size % 60, 2);
}

std::string text_of(const toml::array& array) {
  std::string text = "[";
  const char* separator = "";
  for (const toml::node& item : array) {
    text += separator + toml_text(item);
    separator = ", ";
  }
  return text + "]";
}

std::string text_of(const toml::table& table) {
  std::string text = "{ ";
  const char* separator = "";
  for (const auto& [key, value] : table) {
    text += separator + toml_key(key.str()) + " = " + toml_text(value);
    separator = ", ";
  }
  return text + " }";
}

}  // namespace

std::string toml_text(const toml::node& node) {
  return node.visit([](const auto& typed) {
    using Type = std::decay_t<decltype(typed)>;
    if constexpr (std::is_same_v<Type, toml::table> || std::is_same_v<Type, toml::array>)
      return text_of(typed);
    else
      return text_of(typed.get());
  });
}

std::string toml_key(std::string_view key) {
  constexpr std::string_view bare = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_-";
  return !key.empty() && key.find_first_not_of(bare) == std::string_view::npos ? std::string(key) : in_quotes(key);
}

}  // namespace slipfront
