#include "foundation/text/digits.hpp"
#include "scenario/text/document.hpp"
#include "slipfront/scenario/scenario.hpp"

namespace slipfront::scenario {
namespace {

/// As a shell takes it for one word.
std::string quoted(std::string_view word) {
  constexpr std::string_view plain = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_-+./:,=@%";
  if (!word.empty() && word.find_first_not_of(plain) == std::string_view::npos) return std::string(word);
  std::string text = "'";
  for (const char c : word) {
    if (c == '\'')
      text += "'\\''";
    else
      text += c;
  }
  return text + "'";
}

}  // namespace

std::string command_line(const Scenario& scenario, std::string_view command, const std::vector<double>& scales) {
  std::string line = "slipfront " + std::string(command) + " " + quoted(scenario.file);
  for (const std::string& text : scenario.overrides) line += " --set " + quoted(text);
  if (scenario.in_si != scenario.results_in.has_value()) line += scenario.in_si ? " --dimensionless" : " --si";
  for (const double scale : scales) line += " --scale " + shortest(scale);
  return line;
}

}  // namespace slipfront::scenario
