#pragma once
/// \file
/// Errors of solvers in the words of a scenario. Solvers name a part of their problem, such as "contact". Only this
/// file knows which key gives the part, and which command runs what a solver cannot.

#include <string>

#include "slipfront/error.hpp"

namespace slipfront::scenario {

enum class SolverKind { pulse, chain, plane, plane_direct };

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

}  // namespace slipfront::scenario
