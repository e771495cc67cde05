#pragma once

#include <string>

#include "text/parse_toml.hpp"

namespace slipfront {

/// A document as TOML text, and a value as its text in one. Numbers have the shortest form that reads back the same.
std::string toml_document(const toml::table& table);
std::string toml_text(const toml::node& node);

}  // namespace slipfront
