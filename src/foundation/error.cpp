#include "slipfront/error.hpp"

#include <utility>

#include "foundation/text/printable.hpp"

namespace slipfront {
std::string one_line(const Complaint& c) {
  std::string text;  // appended piece by piece: g++ 12 warns of the sum of a literal and a string at -O3
  if (!c.file.empty()) {
    text.append(printable(c.file));
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

InputError::InputError(Complaint complaint)
    : std::invalid_argument(one_line(complaint)), complaint_(std::move(complaint)) {}

}  // namespace slipfront
