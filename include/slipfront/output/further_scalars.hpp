#pragma once
/// \file
/// Numbers of a snapshot without a member of their own: declared once for files, tables, JSON and Python. To add one,
/// add its line to further_scalars.cpp and set it, by its name, where a snapshot is made.

#include <span>
#include <string_view>

#include "slipfront/description.hpp"
#include "slipfront/output/snapshot.hpp"

namespace slipfront::output {

std::span<const Description> further_scalars();

/// The value in a snapshot; NaN if it has none.
double further_scalar(const Snapshot& snapshot, std::string_view name);

/// Integral of a field over the output grid, one value a cell.
double integral(const std::vector<double>& values, const std::vector<double>& x_edges);

}  // namespace slipfront::output
