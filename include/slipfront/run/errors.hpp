#pragma once
/// \file
/// How far the scalars of a pulse may be from those of infinitely many cells.

#include <functional>
#include <vector>

#include "slipfront/run/run.hpp"
#include "slipfront/scenario/scenario.hpp"

namespace slipfront::run {

/// For each row of a finished run's summary its difference from the same row of a run with half the cells and coarser
/// steps, which is made here and takes a quarter of the time. The scheme is of first order or better, so that the error
/// of the finer run is no larger. Slip at x = 0 is known twice: its error is no less than the difference of the two.
/// NaN for what has no error of this kind, and where one of the two runs has no value or `interrupted` said to stop.
std::vector<double> errors_of(const Result<pulse::Run>& fine, const scenario::Scenario& scenario,
                              const std::function<bool()>& interrupted);

/// The cells that a relative tolerance (1e-9 to 1) of slip, slip velocity and stress at x = 0 and of the peak needs,
/// from the scenario's on in doublings; those of the scenario where `interrupted` said to stop. \throws InputError for
/// another tolerance, or one for a run that is `resumed`; NumericsError where 25,600 cells do not reach it.
int cells_for(double tolerance, bool resumed, const scenario::Scenario& scenario,
              const std::function<bool()>& interrupted);

}  // namespace slipfront::run
