#pragma once
/// \file
/// Scenarios as the page gives them.

#include <string>
#include <vector>

#include "answer.hpp"
#include "slipfront/scenario/scenario.hpp"

namespace slipfront::explorer {

/// The scenario of a TOML text, with changes "table.key=value". A table that it names is what the page has drawn or
/// read (set_table). \throws InputError.
scenario::Scenario scenario_of(const char* toml, const std::vector<std::string>& changes = {});

}  // namespace slipfront::explorer
