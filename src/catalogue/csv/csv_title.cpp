#include "catalogue/csv/csv_title.hpp"

#include <algorithm>

#include "foundation/text/trimmed.hpp"

namespace slipfront::catalogue {
namespace {

std::string small_word(std::string_view word) {
  std::string small(word);
  for (char& c : small)
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  if (small.find_first_not_of("+-/") == std::string::npos) return small;
  if (small.size() > 1 && (small.back() == '.' || small.back() == ':')) small.pop_back();
  if (small.find('/') == std::string::npos && small.find_first_of("0123456789") == std::string::npos)
    small.erase(std::remove(small.begin(), small.end(), '-'), small.end());
  return small;
}

/// Moves the texts in parentheses and brackets from `text` to `groups`.
void take_groups(std::string& text, std::vector<std::string>& groups) {
  for (auto open = text.find_first_of("[("); open != std::string::npos; open = text.find_first_of("[(", open)) {
    const auto close = text.find(text[open] == '[' ? ']' : ')', open);
    if (close == std::string::npos) return;
    groups.emplace_back(trimmed(std::string_view(text).substr(open + 1, close - open - 1)));
    std::fill(text.begin() + static_cast<std::ptrdiff_t>(open), text.begin() + static_cast<std::ptrdiff_t>(close) + 1,
              ' ');
  }
}

}  // namespace

Title divide_title(std::string_view title) {
  Title out;
  std::string text(trimmed(title));
  take_groups(text, out.groups);
  if (const auto comma = text.find_last_of(','); comma != std::string::npos) {
    out.groups.emplace_back(trimmed(std::string_view(text).substr(comma + 1)));
    text.erase(comma);
  }
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t end = std::min(text.find_first_of(" _\t\n\r", at), text.size());
    if (end > at) {
      out.words.push_back(text.substr(at, end - at));
      out.small.push_back(small_word(out.words.back()));
    }
    at = end + 1;
  }
  return out;
}

}  // namespace slipfront::catalogue
