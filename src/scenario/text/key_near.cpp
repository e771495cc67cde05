#include "scenario/text/key_near.hpp"

#include <algorithm>

#include "foundation/text/trimmed.hpp"

namespace slipfront::scenario {
namespace {

bool is_bare(std::string_view name) {
  constexpr std::string_view letters = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_-.";
  return !name.empty() && name.size() <= 64 && name.find_first_not_of(letters) == std::string_view::npos;
}

}  // namespace

std::string key_near(std::string_view text, std::size_t line) {
  std::string_view table;
  std::string_view key;
  for (std::size_t number = 1; number <= line && !text.empty(); ++number) {
    const std::size_t end = std::min(text.find('\n'), text.size());
    const std::string_view row = trimmed(text.substr(0, end));
    text.remove_prefix(std::min(end + 1, text.size()));
    const std::string_view name = trimmed(row.substr(0, row.find('=')));
    const std::size_t close = row.find(']');
    if (row.find('=') != std::string_view::npos && is_bare(name)) {
      key = name;
    } else if (row.size() > 1 && row.front() == '[' && close != std::string_view::npos &&
               is_bare(row.substr(1, close - 1))) {
      table = row.substr(1, close - 1);
      key = {};
    }
  }
  if (key.empty()) return std::string(table);
  return (table.empty() ? "" : std::string(table) + ".") + std::string(key);
}

}  // namespace slipfront::scenario
