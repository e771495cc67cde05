#pragma once
/// \file
/// A finite-fault model as a kinematic source, and as the initial slip of a rupture on a plane, which is compared with
/// the model.

#include <string>
#include <vector>

#include "events/finite_fault/on_plane.hpp"
#include "events/finite_fault/source/source.hpp"
#include "events/results/evaluate.hpp"
#include "runs/catalogue.hpp"
#include "runs/summary.hpp"
#include "slipfront/scenario/scenario.hpp"

namespace slipfront::run {

struct FaultResult {
  finite_fault::FiniteSource source;
  results::EventResult event;  ///< its warnings include the notes of the source
};

/// Reads the only text of `scenario`, which must be a finite-fault model, and evaluates it. \throws InputError if it is
/// not, or cannot become a source; FileError if it could not be read.
FaultResult fault_source(const CatalogueScenario& scenario, const finite_fault::SourceOptions& options);

/// A model with its segment as a grid, and what the closed forms infer from it.
struct FaultOnPlane {
  finite_fault::FiniteSource source;
  finite_fault::OnPlane fault;
  results::EventResult event;
};
/// \throws InputError for a model that cannot become a source.
FaultOnPlane fault_on_plane(const std::string& text, const std::string& file);

/// Width of the region around a model, in m, in which nothing slips at first.
double margin_of(const finite_fault::OnPlane& fault);

/// The scenario, with `overrides`. The contact ratio A is the one at which the mean gradient of the slip is the stress
/// Sigma-, in mu A / pi, that the rupture velocity of the event means. The strength of friction is 1.2 times what holds
/// the initial state, and falls to 0. \throws InputError if the model has no rupture velocity below c and
/// `overrides` give no contact ratio; what read_scenario throws.
scenario::Scenario scenario_of_fault(const FaultOnPlane& model, const std::string& file,
                                     const std::vector<std::string>& overrides);

/// How the run compares with the model, in SI units: rupture times, durations and corner frequencies.
std::vector<Row> compare_with_model(const FaultOnPlane& model, const scenario::Scenario& scenario,
                                    const plane::Run& run);

}  // namespace slipfront::run
