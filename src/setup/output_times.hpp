#pragma once

#include <vector>

#include "slipfront/scenario/scenario.hpp"

namespace slipfront::setup {

/// The times of the results of a scenario, ascending: 0, those of [output], and the end.
std::vector<double> output_times(const scenario::Scenario& scenario);

}  // namespace slipfront::setup
