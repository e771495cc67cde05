#pragma once
/// \file
/// Estimates the errors of the numbers of a run by coarser runs.

#include <functional>
#include <string>
#include <vector>

#include "runs/run.hpp"

namespace slipfront::run {

/// The time of the coarser runs, as parts of the time of a pulse or of a run on a plane.
constexpr double cost_of_pulse_errors = 1.0 / 3, cost_of_plane_errors = 1.0 / 4;

/// Sets the error of each row in the summary of a finished run, relative to infinitely many cells. Returns a warning
/// for each row that the cells do not resolve. For this it makes runs with half and a quarter of
/// the cells and with coarser steps, which together take a third of the time.
///
/// If the three values converge, the error is 1.5 times the larger of two changes. One is that of the last doubling of
/// the cells. The other is half of the change at the doubling before, as for a scheme of first order. If they do not
/// converge, the error is three times the larger change (Eca & Hoekstra, 2014, J. Comput. Phys. 262:104). Some rows
/// have a larger error:
/// - Slip at x = 0 is computed in two ways. Its error is at least the one that their difference implies for the cells
///   there.
/// - A front that half the cells do not show has an error of one of their cells.
/// - The position of the peak has an error of at least a cell. The error also covers all other positions that slip as
///   fast within the error of slip velocity.
///
/// An error is NaN for rows without an error of this kind. It is NaN for a front that an observer sees at an end of the
/// domain. It is NaN, with a warning, for a value that each doubling of the cells more than doubles. It is also NaN if
/// the run, or the run with half the cells, has no value, or if `interrupted` returned true.
std::vector<std::string> add_pulse_errors(const pulse::Run& run, std::vector<Row>& summary, const Plan& plan,
                                          const std::function<bool()>& interrupted);

/// Sets the errors of the summary of a finished run by runs with half and a quarter of the cells, or of the scale of a
/// direct run, which take a quarter of its time. An error is 1.5 times the larger of two changes: that of the last
/// doubling, and half of that at the doubling before. There is none if a run with fewer cells fails, or if
/// `interrupted` returned true, and for a direct run with fewer than 20 lines, whose convergence is not regular. The
/// peak slip velocity has no error.
void add_plane_errors(std::vector<Row>& summary, const Plan& plan, const std::function<bool()>& interrupted,
                      int threads);

/// The number of cells for a relative tolerance, 1e-9 to 1. It applies to slip, slip velocity and stress at x = 0, and
/// to the peak slip velocity. The function doubles the cells of the scenario until the tolerance is reached. If
/// `interrupted` returns true, it returns the cells of the scenario. \throws InputError for another tolerance, or for a
/// run that is `resumed`; NumericsError if 25,600 cells do not reach the tolerance or the next doubling would take too
/// many steps.
int cells_for(double tolerance, bool resumed, const scenario::Scenario& scenario,
              const std::function<bool()>& interrupted);

}  // namespace slipfront::run
