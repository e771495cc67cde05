#include "slipfront/error.hpp"

#include <utility>

#include "text/characters.hpp"

namespace slipfront {
std::string one_line(const Complaint& c) {
  std::string text;  // appended piece by piece: g++ 12 warns of the sum of a literal and a string at -O3
  if (!c.file.empty()) {
    text.append(printable(c.file, 800));
    if (c.line > 0) text.append(":").append(std::to_string(c.line));
    text.append(": ");
  }
  text.append(printable(c.key, 80));
  if (!c.value.empty()) text.append(c.key.empty() ? "'" : " = '").append(printable(c.value, 80)).append("'");
  if (!c.key.empty() || !c.value.empty()) text.append(": ");
  text.append(printable(c.problem, 400));  // a parser may quote the line break that it stumbled over
  if (!c.allowed.empty()) text.append("; allowed: ").append(printable(c.allowed, 1000));
  return text;
}

namespace {
std::string lines_of(const Complaint& first, const std::vector<Complaint>& others) {
  std::string text = one_line(first);
  for (const Complaint& c : others) text.append("\n").append(one_line(c));
  return text;
}
}  // namespace

InputError::InputError(Complaint complaint) : InputError(std::move(complaint), {}) {}

InputError::InputError(Complaint first, std::vector<Complaint> others)
    : std::invalid_argument(lines_of(first, others)), complaints_(std::move(others)) {
  complaints_.insert(complaints_.begin(), std::move(first));
}

}  // namespace slipfront
