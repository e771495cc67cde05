#include "state_values.hpp"

#include <cmath>
#include <string_view>

#include "slipfront/error.hpp"
#include "slipfront/text/quantity.hpp"
#include "system/files/whole_file.hpp"

namespace {

using slipfront::InputError;
using slipfront::medium::number;

constexpr double most_points = 1e7;

std::vector<std::string_view> split(std::string_view text, char separator) {
  std::vector<std::string_view> parts;
  while (true) {
    const std::size_t end = text.find(separator);
    parts.push_back(text.substr(0, end));
    if (end == std::string_view::npos) return parts;
    text.remove_prefix(end + 1);
  }
}

std::vector<StateValue> range(const std::string& text, const std::string& option) {
  const auto refuse = [&](const char* problem) {
    return InputError({.file = "command line",
                       .key = option,
                       .value = text,
                       .problem = problem,
                       .allowed = "first:last:count or first:last:count:log, such as 0.1:1:10"});
  };
  const auto parts = split(text, ':');
  const bool log = parts.size() == 4 && parts[3] == "log";
  if (parts.size() != 3 && !log) throw refuse("not a number and not a range");
  const auto first = number(parts[0]), last = number(parts[1]), count = number(parts[2]);
  if (!first || !last || !count) throw refuse("a part of the range is not a finite number");
  if (*count < 1 || *count > most_points || *count != std::floor(*count))
    throw refuse("the count is not a whole number from 1 to 10000000");
  if (log && !(*first > 0 && *last > 0)) throw refuse("a logarithmic range needs positive ends");
  const auto n = static_cast<std::size_t>(*count);
  std::vector<StateValue> values(n, {*first, 0});
  for (std::size_t i = 1; i < n; ++i) {
    const double part = static_cast<double>(i) / static_cast<double>(n - 1);
    values[i].value =
        log ? std::exp(std::log(*first) * (1 - part) + std::log(*last) * part) : *first * (1 - part) + *last * part;
  }
  if (n > 1) values.back().value = *last;
  return values;
}

std::vector<StateValue> from_stdin(const std::string& option) {
  std::vector<StateValue> values;
  std::size_t line = 0;
  const std::string text = slipfront::record::read_standard_input();
  for (std::string_view row : split(text, '\n')) {
    ++line;
    row = row.substr(0, row.find('#'));
    if (row.find_first_not_of(" \t\r") == std::string_view::npos) continue;
    const auto value = number(row);
    if (!value)
      throw InputError({.file = "stdin",
                        .line = line,
                        .key = option,
                        .value = std::string(row),
                        .problem = "not a finite number",
                        .allowed = "one number a line"});
    values.push_back({*value, line});
  }
  if (values.empty())
    throw InputError({.file = "stdin", .key = option, .problem = "no numbers", .allowed = "one number a line"});
  return values;
}

}  // namespace

std::vector<StateValue> state_values(const std::string& text, const std::string& option,
                                     const std::function<double(const std::string&)>& in_model) {
  if (text == "-") return from_stdin(option);
  if (text.find(':') != std::string::npos) return range(text, option);
  if (const auto value = number(text)) return {{*value, 0}};
  if (text.find_first_of("0123456789") < text.find_last_of(' ')) return {{in_model(text), 0}};
  throw InputError({.file = "command line",
                    .key = option,
                    .value = text,
                    .problem = "not a finite number",
                    .allowed = "a number, a number with a unit, a range first:last:count, or - for stdin"});
}
