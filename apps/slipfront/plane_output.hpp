#pragma once
/// \file
/// Prints the results of a run on a plane.

#include "long_run.hpp"
#include "run/fault_plane.hpp"

/// `model` is the finite-fault model with which the results are compared, or null. Prints the results with their errors
/// as a table or as one JSON object on stdout, and the warnings of the run on stderr.
void print_plane(const slipfront::scenario::Scenario& scenario, const slipfront::run::PlaneResult& result,
                 const slipfront::run::PlaneNumbers& errors, const slipfront::run::FaultOnPlane* model,
                 const ScenarioArguments& arguments);
