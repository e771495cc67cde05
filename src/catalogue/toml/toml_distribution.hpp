#pragma once

#include <string>

#include "catalogue/keys.hpp"
#include "foundation/text/parse_toml.hpp"

namespace slipfront::catalogue {

/// A quantity as a table: { mean, sd }, { median, factor } or { low, high }, each a number with its unit but `factor`.
/// \throws InputError (line, key, value, problem, allowed).
Measured read_distribution(const toml::table& table, const std::string& full_key, const Key& key);

/// The text of a value, a number printed so that it reads back the same; empty if it is neither.
std::string quantity_text(const toml::node& node);

}  // namespace slipfront::catalogue
