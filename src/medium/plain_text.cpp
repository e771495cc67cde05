#include "medium/plain_text.hpp"

#include <algorithm>
#include <utility>

#include "foundation/text/characters.hpp"
#include "foundation/text/digits.hpp"
#include "foundation/text/trimmed.hpp"
#include "medium/units.hpp"
#include "slipfront/medium/quantity.hpp"

namespace slipfront::medium {
namespace {

void replace_all(std::string& text, std::string_view from, std::string_view to) {
  for (std::size_t at = text.find(from); at != std::string::npos; at = text.find(from, at + to.size()))
    text.replace(at, from.size(), to);
}

constexpr std::pair<std::string_view, std::string_view> characters[] = {
    {"\xC2\xA0", " "},                 // no-break space
    {"\xE2\x80\x89", " "},             // thin space
    {"\xE2\x80\xAF", " "},             // narrow no-break space
    {"\xE2\x88\x92", "-"},             // minus sign
    {"\xE2\x80\x90", "-"},             // hyphen
    {"\xE2\x80\x91", "-"},             // non-breaking hyphen
    {"\xE2\x81\xBB", "-"},             // superscript minus
    {"\xC2\xB7", " "},                 // middle dot
    {"\xE2\x8B\x85", " "},             // dot operator
    {"\xC2\xB5", "u"},                 // micro sign
    {"\xCE\xBC", "u"},                 // Greek mu
    {"\xC3\x97", "x"},                 // multiplication sign
    {"\xE2\x89\xA4", "<"},             // less or equal
    {"\xE2\x89\xA5", ">"},             // greater or equal
    {"\xE2\x89\x88", "~"},             // almost equal
    {"\xE2\x80\x94", "\xE2\x80\x93"},  // em dash -> en dash
    {"\xE2\x80\x92", "\xE2\x80\x93"},  // figure dash -> en dash
};
constexpr std::string_view superscripts[] = {"\xE2\x81\xB0", "\xC2\xB9",     "\xC2\xB2",     "\xC2\xB3",
                                             "\xE2\x81\xB4", "\xE2\x81\xB5", "\xE2\x81\xB6", "\xE2\x81\xB7",
                                             "\xE2\x81\xB8", "\xE2\x81\xB9"};

/// Replaces typographic characters. A superscript after "10" is an exponent.
std::string plain_characters(std::string_view text) {
  std::string plain(text);
  if (std::all_of(plain.begin(), plain.end(), [](char c) { return static_cast<unsigned char>(c) < 0x80; }))
    return plain;
  replace_all(plain, "10\xE2\x81\xBB", "10^-");  // a superscript minus
  for (const auto& digit : superscripts) replace_all(plain, "10" + std::string(digit), "10^" + std::string(digit));
  for (std::size_t i = 0; i < std::size(superscripts); ++i)
    replace_all(plain, superscripts[i], std::string(1, static_cast<char>('0' + i)));
  for (const auto& [from, to] : characters) replace_all(plain, from, to);
  return plain;
}

/// "1.2 x 10^18" -> "1.2e18".
void join_powers_of_ten(std::string& text) {
  for (std::size_t at = text.find("10^"); at != std::string::npos; at = text.find("10^", at + 1)) {
    std::size_t begin = at;
    while (begin > 0 && text[begin - 1] == ' ') --begin;
    if (begin == 0 || std::string_view("xX*").find(text[begin - 1]) == std::string_view::npos) continue;
    --begin;
    while (begin > 0 && text[begin - 1] == ' ') --begin;
    if (begin > 0 && (is_digit(text[begin - 1]) || text[begin - 1] == '.')) text.replace(begin, at + 3 - begin, "e");
  }
}

/// A dash or the word "to" between two numbers is a range; a dash before a number is its sign.
void join_ranges(std::string& text) {
  for (const std::string_view word : {"\xE2\x80\x93", " to "}) {
    for (std::size_t at = text.find(word); at != std::string::npos; at = text.find(word, at + 1)) {
      const std::string_view after = trimmed(std::string_view(text).substr(at + word.size()));
      const std::string_view before = trimmed(std::string_view(text).substr(0, at));
      const bool number_follows = !after.empty() && (is_digit(after.front()) || after.front() == '.');
      if (number_follows) text.replace(at, word.size(), before.empty() ? "-" : " .. ");
    }
  }
}

bool is_known(std::string_view unit) { return parse_unit(unit).has_value(); }

}  // namespace

std::string plain_number(std::string_view text) {
  std::string plain = plain_characters(text);
  join_powers_of_ten(plain);
  join_ranges(plain);
  return std::string(trimmed(plain));
}

std::string plain_unit(std::string_view text) {
  std::string unit = plain_characters(trimmed(text));
  if (unit.size() > 1 && ((unit.front() == '(' && unit.back() == ')') || (unit.front() == '[' && unit.back() == ']')))
    unit = unit.substr(1, unit.size() - 2);
  unit = trimmed(unit);
  for (const auto& [from, to] : {std::pair<std::string_view, std::string_view>{"Nm", "N m"},
                                 {"N-m", "N m"},
                                 {"dyn-cm", "dyne cm"},
                                 {"dyne-cm", "dyne cm"},
                                 {"dyn cm", "dyne cm"},
                                 {"dyncm", "dyne cm"},
                                 {"dyn.cm", "dyne cm"},
                                 {"dyn*cm", "dyne cm"}})
    if (unit == from) return std::string(to);
  if (unit.empty() || is_known(unit)) return unit;
  std::string small = small_letters(unit);
  replace_all(small, "hrs", "hr");
  replace_all(small, "yrs", "yr");
  replace_all(small, "secs", "s");
  if (small == "wk" || small == "wks") small = "week";
  if (small == "mins") small = "min";
  if (is_known(small)) return small;
  return unit;
}

std::string plain_column_unit(std::string_view text) {
  std::string plain = plain_number(text);
  if (plain.starts_with('x')) plain = trimmed(std::string_view(plain).substr(1));
  if (plain.starts_with("10^")) plain.replace(0, 3, "1e");
  const auto blank = plain.find(' ');
  const auto scale = number(std::string_view(plain).substr(0, blank));
  const std::string unit = scale && blank != std::string::npos ? plain_unit(plain.substr(blank)) : "";
  if (!is_known(unit) || !(*scale > 0)) return plain_unit(text);
  std::string factor = shortest(*scale);
  factor.erase(std::remove(factor.begin(), factor.end(), '+'), factor.end());
  return factor + " " + unit;
}

}  // namespace slipfront::medium
