#pragma once
/// \file
/// Numbers of a snapshot that are not members of Snapshot. Each is declared once, for files, tables, JSON and Python.
/// To add one, add its line to further_scalars.cpp. Compute it there too if it follows from the rest of a snapshot at
/// every level of theory. Otherwise set it by name where a run is observed (pulse/observe, chain/run_observer.cpp).

#include <span>
#include <string_view>

#include "slipfront/description.hpp"
#include "slipfront/output/snapshot.hpp"

namespace slipfront::output {

std::span<const Description> further_scalars();

/// The value in a snapshot; NaN if it has none.
double further_scalar(const Snapshot& snapshot, std::string_view name);

/// Adds the numbers that follow from the rest of the snapshot.
void add_further_scalars(Snapshot& snapshot, const Schedule& schedule);

}  // namespace slipfront::output
