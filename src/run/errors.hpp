#pragma once
/// \file
/// How far the scalars of a pulse may be from those of infinitely many cells.

#include <functional>
#include <string>
#include <vector>

#include "run/run.hpp"
#include "slipfront/scenario/scenario.hpp"

namespace slipfront::run {

/// How far the rows of a summary may be from those of infinitely many cells.
struct Errors {
  std::vector<double> of;             ///< each row; NaN where no error is known
  std::vector<std::string> warnings;  ///< a sentence for each row that the cells do not resolve
};

/// For each row of a finished run's summary an estimate of its error, from runs with half and a quarter of the cells
/// and coarser steps, which are made here and take a third of the time: what the last doubling of the cells changed, or
/// half of what the doubling before did if that is more, as for a scheme of first order, times 1.5; and where the three
/// values do not converge, three times the larger change (Eca & Hoekstra, 2014, J. Comput. Phys. 262:104). Slip at
/// x = 0 is known twice: its error is no less than what the difference of the two says of the cells there. A front that
/// half the cells do not show is known to one of their cells. The position of the peak is known to a cell at
/// best, and no better than how far other places are that slip as fast but for the error. NaN for what has no error of
/// this kind, for a front that an observer sees at an end of the domain, for what each doubling of the cells more than
/// doubles, with a warning, and where the run or the one with half the cells has no value or `interrupted` said to
/// stop.
Errors errors_of(const Result<pulse::Run>& fine, const scenario::Scenario& scenario,
                 const std::function<bool()>& interrupted);

/// The cells that a relative tolerance (1e-9 to 1) of slip, slip velocity and stress at x = 0 and of the peak needs,
/// from the scenario's on in doublings; those of the scenario where `interrupted` said to stop. \throws InputError for
/// another tolerance, or one for a run that is `resumed`; NumericsError where 25,600 cells do not reach it.
int cells_for(double tolerance, bool resumed, const scenario::Scenario& scenario,
              const std::function<bool()>& interrupted);

}  // namespace slipfront::run
