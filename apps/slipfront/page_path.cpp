#include "page_path.hpp"

#include <algorithm>
#include <charconv>

namespace {

std::string decoded(std::string_view text) {
  std::string result;
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (text[i] != '%') {
      result += text[i];
      continue;
    }
    const std::string_view digits = text.substr(i + 1, 2);
    unsigned char value = 0;
    const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), value, 16);
    if (error != std::errc() || end != digits.data() + 2)
      throw RefusedRequest(400, "The path has a '%' without two hexadecimal digits.");
    result += static_cast<char>(value);
    i += 2;
  }
  return result;
}

/// A dot at the beginning covers "..", "." and files that are hidden.
bool is_served_name(const std::string& name) {
  if (name.empty() || name[0] == '.') return false;
  return std::none_of(name.begin(), name.end(),
                      [](char c) { return c == '/' || c == '\\' || static_cast<unsigned char>(c) < 0x20; });
}

}  // namespace

std::vector<std::string> page_path(std::string_view target) {
  target = target.substr(0, target.find_first_of("?#"));
  if (target.empty() || target[0] != '/') throw RefusedRequest(400, "The path does not begin with '/'.");
  if (target == "/") return {"index.html"};
  std::vector<std::string> names;
  while (!target.empty()) {
    target.remove_prefix(1);
    const std::size_t end = std::min(target.find('/'), target.size());
    names.push_back(decoded(target.substr(0, end)));
    if (!is_served_name(names.back())) throw RefusedRequest(404, "There is no such file.");
    target.remove_prefix(end);
  }
  return names;
}
