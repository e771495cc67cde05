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
  std::string text;
  if (!c.file.empty()) {
    text += c.file;
    if (c.line > 0) text += ":" + std::to_string(c.line);
    text += ": ";
  }
  if (!c.key.empty()) {
    text += shown(c.key);
    if (!c.value.empty()) text += " = '" + shown(c.value) + "'";
    text += ": ";
  } else if (!c.value.empty()) {
    text += "'" + shown(c.value) + "': ";
  }
  text += shown(c.problem, 400);  // a parser may quote the line break that it stumbled over
  if (!c.allowed.empty()) text += "; allowed: " + shown(c.allowed, 1000);
  return text;
}

InputError::InputError(Complaint complaint)
    : std::invalid_argument(one_line(complaint)), complaint_(std::move(complaint)) {}

}  // namespace slipfront
