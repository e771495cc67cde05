#pragma once
/// \file
/// Turns a finite-fault model into a kinematic source. The program uses this file.

#include "finite_fault/source/source.hpp"
#include "results/evaluate.hpp"
#include "run/catalogue.hpp"

namespace slipfront::run {

struct FaultResult {
  finite_fault::FiniteSource source;
  results::EventResult event;  ///< its warnings include the notes of the source
};

/// Reads the only text of `scenario`, which must be a finite-fault model, and evaluates it. \throws InputError if it is
/// not, or cannot become a source; FileError if it could not be read.
FaultResult fault_source(const CatalogueScenario& scenario, const finite_fault::SourceOptions& options);

}  // namespace slipfront::run
