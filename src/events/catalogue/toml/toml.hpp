#pragma once

#include <string>

#include "events/catalogue/keys.hpp"
#include "text/toml.hpp"

namespace slipfront::catalogue {

/// Reads a quantity given as a table: { mean, sd }, { median, factor } or { low, high }. Each entry is a number with
/// its unit, except `factor`, which has none. \throws InputError (line, key, value, problem, allowed).
MeasuredValue read_distribution(const toml::table& table, const std::string& full_key, const Key& key);

/// The text of a value. A number is printed with all digits, so that it is read back unchanged. The result is empty if
/// the value is neither a text nor a number.
std::string quantity_text(const toml::node& node);

}  // namespace slipfront::catalogue
