#include "foundation/text/characters.hpp"
#include "foundation/text/nearest.hpp"
#include "scenario/formula/formula.hpp"
#include "slipfront/error.hpp"
#include "slipfront/medium/quantity.hpp"

namespace slipfront::scenario {
namespace {

constexpr std::size_t longest = 4096;
constexpr int deepest = 100;

bool is_letter(char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_'; }

InputError refusal(const std::string& problem, std::size_t at, std::string allowed) {
  return InputError({.problem = problem + " at character " + std::to_string(at + 1), .allowed = std::move(allowed)});
}

/// Returns the end of the number that begins at `at`. "2e" is the number 2 and the name e.
std::size_t past_number(const std::string& text, std::size_t at) {
  const auto digits = [&](std::size_t i) {
    while (i < text.size() && is_digit(text[i])) ++i;
    return i;
  };
  std::size_t end = digits(at);
  if (end < text.size() && text[end] == '.') end = digits(end + 1);
  if (end < text.size() && (text[end] == 'e' || text[end] == 'E')) {
    std::size_t power = end + 1;
    if (power < text.size() && (text[power] == '+' || text[power] == '-')) ++power;
    if (digits(power) > power) end = digits(power);
  }
  return end;
}

/// Rejects a '=' that is not part of a comparison, because the parser would assign to x.
void check_equals(const std::string& text, std::size_t at) {
  const char before = at > 0 ? text[at - 1] : ' ';
  const char after = at + 1 < text.size() ? text[at + 1] : ' ';
  const bool second = before == '=' || before == '<' || before == '>' || before == '!';
  if (!second && after != '=') throw refusal("'='", at, "a formula without assignment; == compares");
}

/// Counts parentheses, and rejects a comma that separates values instead of the arguments of a function.
void check_structure(const std::string& text, std::size_t at, int& depth) {
  if (text[at] == '(') ++depth;
  if (text[at] == ')') --depth;
  if (depth < 0) throw refusal("')' without '('", at, "as many '(' as ')'");
  if (depth > deepest) throw refusal("parentheses too deep", at, std::to_string(deepest) + " levels");
  if (text[at] == ',' && depth == 0) throw refusal("a comma outside parentheses", at, "one value; decimals with '.'");
}

}  // namespace

void scan_formula(const std::string& text, const std::vector<std::string_view>& variables) {
  constexpr std::string_view signs = "+-*/^(),<>=!&|?: \t\r\n";
  if (text.size() > longest)
    throw InputError({.problem = "a formula too long", .allowed = std::to_string(longest) + " characters"});
  std::vector<std::string_view> names = variables;
  names.insert(names.end(), {"pi", "e"});
  names.insert(names.end(), formula_functions().begin(), formula_functions().end());
  int depth = 0;
  for (std::size_t i = 0; i < text.size();) {
    const std::size_t at = i;
    if (is_digit(text[i]) || text[i] == '.') {
      i = past_number(text, i);
      if (!medium::number(text.substr(at, i - at)))
        throw refusal("not a finite number", at, "numbers that a double can hold");
    } else if (is_letter(text[i])) {
      while (i < text.size() && (is_letter(text[i]) || is_digit(text[i]))) ++i;
      const std::string name = text.substr(at, i - at);
      bool known = false;
      for (const std::string_view candidate : names) known = known || candidate == name;
      if (!known) throw refusal("unknown name '" + name.substr(0, 40) + "'", at, nearest_or_all(name, names));
    } else {
      if (signs.find(text[i]) == std::string_view::npos)
        throw refusal("a character that is not allowed", at, "names, numbers and + - * / ^ ( ) , < > = ! & | ? :");
      if (text[i] == '=') check_equals(text, i);
      check_structure(text, i, depth);
      ++i;
    }
  }
  if (depth > 0) throw refusal("')' is missing", text.size(), "as many '(' as ')'");
}

}  // namespace slipfront::scenario
