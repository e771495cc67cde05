#pragma once
/// \file
/// Errors of solvers in the words of a scenario. Solvers name a part of their problem, such as "contact". Only this
/// file knows which key gives the part, and which command runs what a solver cannot.

#include <optional>
#include <string>
#include <string_view>

#include "slipfront/error.hpp"
#include "slipfront/scenario/scenario.hpp"

namespace slipfront::scenario {

/// The error with the key and the file of the scenario. An error in anything else does not change. `slip_key` is the
/// key of [initial] that gives the slip on a plane.
InputError in_keys(SolverKind solver, const std::string& file, const InputError& error,
                   const char* slip_key = "initial.formula");

/// Does `task`, whose errors get the keys and the file of the scenario.
template <class Task>
auto with_keys(SolverKind solver, const std::string& file, const Task& task, const char* slip_key = "initial.formula") {
  try {
    return task();
  } catch (const InputError& error) {
    throw in_keys(solver, file, error, slip_key);
  }
}

/// The message of a solver in the units of the results: "t = 2.5" becomes "t = 3.1e-05 s", and "x = 1" and "y = 1" get
/// metres. Nothing changes if the results are in the units of the model.
std::string in_results(std::string_view message, const std::optional<medium::SiUnits>& units);

/// Does `task`, whose errors are in the units of the results.
template <class Task>
auto with_units(const Scenario& scenario, const Task& task) {
  try {
    return task();
  } catch (const InputError& error) {
    Complaint complaint = error.complaint();
    complaint.problem = in_results(complaint.problem, scenario.results_in);
    throw InputError(complaint);
  }
}

}  // namespace slipfront::scenario
