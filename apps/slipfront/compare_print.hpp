#pragma once

#include "slipfront/setup/compare.hpp"

/// As a table or as one JSON object, on stdout.
void print_comparison(const slipfront::scenario::Scenario& scenario, const std::vector<slipfront::setup::Level>& levels,
                      bool json);
