#pragma once

#include "runs/compare.hpp"

/// As a table or as one JSON object, on stdout.
void print_comparison(const slipfront::scenario::Scenario& scenario,
                      const std::vector<slipfront::run::ComparedModel>& levels, bool json);
