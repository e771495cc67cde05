#pragma once

#include <string>
#include <vector>

#include "catalogue/population.hpp"

/// Decades of rupture velocity as a JSON array, slowest first; null where nothing is known.
std::string population_json(const std::vector<slipfront::catalogue::Decade>& decades);

/// The same as CSV with a header, full precision; empty where nothing is known.
std::string population_csv(const std::vector<slipfront::catalogue::Decade>& decades);

/// A table for people, of `events` of which `errors` were refused.
std::string population_table(const std::vector<slipfront::catalogue::Decade>& decades, std::size_t events,
                             std::size_t errors);
