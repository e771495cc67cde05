#pragma once
/// \file
/// Scenarios as the page gives them.

#include <string>

#include "answer.hpp"
#include "slipfront/scenario/scenario.hpp"

namespace slipfront::explorer {

/// The scenario of a TOML text. A table that it names is what the page has drawn or read (set_table).
/// \throws InputError.
scenario::Scenario scenario_of(const char* toml);

}  // namespace slipfront::explorer
