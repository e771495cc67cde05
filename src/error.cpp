#include "slipfront/error.hpp"

#include <utility>

namespace slipfront {
namespace {

/// Text as it may be shown: one line, no control characters, no more than fits.
std::string shown(const std::string& text, std::size_t most = 80) {
  std::string out;
  for (const char c : text) {
    if (out.size() == most) return out + "...";
    const auto byte = static_cast<unsigned char>(c);
    out += (byte < 0x20 || byte == 0x7f) ? '?' : c;
  }
  return out;
}

}  // namespace

std::string one_line(const Complaint& c) {
  std::string text;  // appended piece by piece: g++ 12 warns of the sum of a literal and a string at -O3
  if (!c.file.empty()) {
    text.append(c.file);
    if (c.line > 0) text.append(":").append(std::to_string(c.line));
    text.append(": ");
  }
  text.append(shown(c.key));
  if (!c.value.empty()) text.append(c.key.empty() ? "'" : " = '").append(shown(c.value)).append("'");
  if (!c.key.empty() || !c.value.empty()) text.append(": ");
  text.append(shown(c.problem, 400));  // a parser may quote the line break that it stumbled over
  if (!c.allowed.empty()) text.append("; allowed: ").append(shown(c.allowed, 1000));
  return text;
}

InputError::InputError(Complaint complaint)
    : std::invalid_argument(one_line(complaint)), complaint_(std::move(complaint)) {}

}  // namespace slipfront
