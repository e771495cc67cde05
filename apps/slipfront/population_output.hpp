#pragma once

#include <string>
#include <vector>

#include "events/catalogue/population.hpp"

/// Decades of rupture velocity as a JSON array, slowest first. Unknown quantities are null.
std::string population_json(const std::vector<slipfront::catalogue::Decade>& decades);

/// Decades of rupture velocity as CSV with a header, in full precision. Unknown quantities are empty.
std::string population_csv(const std::vector<slipfront::catalogue::Decade>& decades);

/// A table for the terminal. `errors` of the `events` were refused.
std::string population_table(const std::vector<slipfront::catalogue::Decade>& decades, std::size_t events,
                             std::size_t errors);
