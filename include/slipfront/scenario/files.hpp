#pragma once
/// \file
/// The files that a scenario names.

#include <string>
#include <vector>

#include "slipfront/scenario/scenario.hpp"

namespace slipfront::scenario {

/// The paths of the files from which a run of this scenario reads: its own, and its tables.
std::vector<std::string> files_of(const Scenario& scenario);

}  // namespace slipfront::scenario
