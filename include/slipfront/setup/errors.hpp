#pragma once
/// \file
/// How far the scalars of a pulse run may be from those of infinitely many cells.

#include <functional>
#include <vector>

#include "slipfront/scenario/scenario.hpp"
#include "slipfront/setup/summary.hpp"

namespace slipfront::setup {

/// The summary of a run of `cells` cells to the end, without outputs on the way; empty if `interrupted` said so.
/// \throws InputError, NumericsError as the run itself.
std::vector<SummaryValue> pulse_summary_with(const scenario::Scenario& scenario, int cells,
                                             const std::function<bool()>& interrupted);

/// For each row of a summary its difference from the same row of a run with half the cells. The scheme is of first
/// order or better, so that the error of the finer run is no larger. NaN for what has no error of this kind, and where
/// one of the two runs has no value.
std::vector<double> differences(const std::vector<SummaryValue>& fine, const std::vector<SummaryValue>& coarse);

/// The largest of `errors` over the size of what it belongs to, over the rows that a tolerance is asked of: slip, slip
/// velocity and stress at x = 0 and the peak. Sizes are at least a thousandth of the stress there.
double largest_relative(const std::vector<SummaryValue>& fine, const std::vector<double>& errors);

}  // namespace slipfront::setup
