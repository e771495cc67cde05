/// \file
/// The writer of toml++ needs the streams of the C++ library, which are a tenth of the download. The page writes no
/// scenario, and of an event only its date.

#include "text/toml.hpp"

namespace slipfront {
namespace {

std::string two_digits(int number) { return (number < 10 ? "0" : "") + std::to_string(number); }

}  // namespace

std::string toml_document(const toml::table&) { return {}; }

std::string toml_text(const toml::node& node) {
  if (const auto number = node.value_exact<std::int64_t>()) return std::to_string(*number);
  auto date = node.value_exact<toml::date>();
  if (const auto date_time = node.value_exact<toml::date_time>()) date = date_time->date;
  return date ? std::to_string(date->year) + "-" + two_digits(date->month) + "-" + two_digits(date->day) : "";
}

}  // namespace slipfront
