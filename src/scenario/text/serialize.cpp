#include "scenario/text/serialize.hpp"

#include <type_traits>

#include "foundation/text/plain_stream.hpp"
#include "scenario/text/document.hpp"

namespace slipfront::scenario {
namespace {

std::string in_quotes(std::string_view text) {
  constexpr std::string_view digits = "0123456789ABCDEF";
  std::string out = "\"";
  for (const char c : text) {
    const auto byte = static_cast<unsigned char>(c);
    if (c == '"' || c == '\\') {
      out += '\\';
      out += c;
    } else if (byte < 0x20 || byte == 0x7F) {
      out += "\\u00";
      out += digits[byte / 16u];
      out += digits[byte % 16u];
    } else {
      out += c;
    }
  }
  return out + "\"";
}

std::string serialized_key(std::string_view view) {
  const std::string key(view);
  constexpr std::string_view bare = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_-";
  return !key.empty() && key.find_first_not_of(bare) == std::string_view::npos ? key : in_quotes(key);
}

std::string number(double value) {
  const std::string text = shortest(value);
  return text.find_first_of(".en") == std::string::npos ? text + ".0" : text;  // also of inf and nan
}

void write(std::ostream& out, const toml::node& node);

void write_array(std::ostream& out, const toml::array& array) {
  const char* separator = "";
  out << "[";
  for (const toml::node& item : array) {
    out << separator;
    write(out, item);
    separator = ", ";
  }
  out << "]";
}

void write_inline(std::ostream& out, const toml::table& table) {
  const char* separator = "";
  out << "{ ";
  for (const auto& [key, value] : table) {
    out << separator << serialized_key(key.str()) << " = ";
    write(out, value);
    separator = ", ";
  }
  out << " }";
}

void write(std::ostream& out, const toml::node& node) {
  node.visit([&](const auto& typed) {
    using Type = std::decay_t<decltype(typed)>;
    if constexpr (std::is_same_v<Type, toml::table>) {
      write_inline(out, typed);
    } else if constexpr (std::is_same_v<Type, toml::array>) {
      write_array(out, typed);
    } else if constexpr (std::is_same_v<Type, toml::value<std::string>>) {
      out << in_quotes(typed.get());
    } else if constexpr (std::is_same_v<Type, toml::value<double>>) {
      out << number(typed.get());
    } else if constexpr (std::is_same_v<Type, toml::value<bool>>) {
      out << (typed.get() ? "true" : "false");
    } else {
      out << typed.get();  // integers and dates
    }
  });
}

void write_entries(std::ostream& out, const toml::table& table, bool top) {
  for (const auto& [key, value] : table) {
    if (top && value.is_table()) continue;
    out << serialized_key(key.str()) << " = ";
    write(out, value);
    out << "\n";
  }
}

}  // namespace

std::string serialize(const toml::table& root, const std::vector<std::string>& overrides) {
  std::ostringstream out = plain_stream();
  for (const std::string& text : overrides) out << "# --set " << text << "\n";
  write_entries(out, root, true);
  for (const auto& [key, value] : root) {
    if (!value.is_table()) continue;
    out << "\n[" << serialized_key(key.str()) << "]\n";
    write_entries(out, *value.as_table(), false);
  }
  return out.str();
}

}  // namespace slipfront::scenario
