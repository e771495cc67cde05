#pragma once
/// \file
/// The computations and results of `slipfront compare`: the closed form, the pulse solver and the chain, for one
/// scenario.

#include <cstddef>
#include <functional>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "runs/run.hpp"
#include "slipfront/scenario/scenario.hpp"
#include "slipfront/text/output/quantities.hpp"

namespace slipfront::run {

/// One level: a model with its settings and its results.
struct ComparedModel {
  std::string name;  ///< "closed-form", "pulse-consistent", "pulse-paper", "chain-1000"
  std::string closure = {};
  std::optional<double> scale = {};  ///< only for a chain
  std::vector<output::Snapshot> snapshots = {};
  std::vector<Row> numbers = {};           ///< those of its run; empty for the closed form
  std::vector<std::string> warnings = {};  ///< warnings of the run, one sentence each
  double wall_seconds = 0;

  std::optional<double> number(const Description& about) const;  ///< absent unless its run has this number
};

/// The checked plans of all levels.
struct Comparison {
  output::Schedule schedule = {};
  std::optional<ComparedModel> exact = {};  ///< the closed form, if there is one
  std::vector<Plan> plans = {};             ///< the pulse with each closure, then the chains
  scenario::Estimate need = {};
  std::size_t levels() const { return plans.size() + (exact ? 1 : 0); }
};

/// Plans all levels and checks them before any run. `scales` are those of the chains; if they are empty, they are the
/// scale of the scenario, or 100, 300 and 1000. \throws InputError for an error in any level, and for a scale that is
/// not > 0 or given twice.
Comparison comparison_of(const scenario::Scenario& scenario, std::vector<double> scales);

/// Begins each level and takes no step, to find what a run refuses at its start. \throws InputError like a run.
void begin_levels(const Comparison& comparison);

/// Begins each level, and returns about how many seconds all of them take (expected_duration of a run). \throws
/// InputError, NumericsError like a run.
double expected_seconds(const Comparison& comparison, int threads);

/// The variables of the file of a comparison. They refer to the levels.
std::vector<record::Array> arrays_of(const Comparison& comparison, const record::RunMetadata& metadata,
                                     const std::vector<ComparedModel>& levels);

/// Runs the levels in order, appends each to `levels` when it is finished, and writes them. It calls `next` before each
/// run. `after_step` (level, its time, its number of steps) may stop all runs by returning true. Returns whether all
/// levels are finished. \throws NumericsError that names the level, FileError.
bool compare(const Comparison& comparison, const record::RunMetadata& metadata, const record::Output& output,
             int threads, std::vector<ComparedModel>& levels, const std::function<void()>& next,
             const std::function<bool(const std::string& level, double time, long steps)>& after_step);

/// The closed form on the output grid: the exact solution of the Riemann problem (Eqs. 8-10 if the right side is
/// empty). There is none with friction, forcing or a contact profile, without a step, or if waves reach an end of the
/// domain.
std::optional<ComparedModel> closed_form(const scenario::Scenario& scenario, const output::Schedule& schedule);

/// The numbers for which the levels are compared at the end of the run.
const std::vector<output::Scalar>& compared_numbers();

/// The level that the others are compared with: the pulse solver with closure "consistent". Null if it was not run.
const ComparedModel* reference_level(const std::vector<ComparedModel>& levels);

/// Dependence on scale of the difference between the chain and the reference. NaN if it is unknown.
struct Trend {
  /// Negative slope of ln |difference| against ln scale, by least squares. It is 1 if the difference falls as 1 /
  /// scale. It needs two scales.
  double exponent = std::numeric_limits<double>::quiet_NaN();
  /// Extrapolation to infinite scale from the two largest scales, with a difference that falls as 1 / scale. NaN if the
  /// exponent is negative, because then the difference does not fall.
  double extrapolated = std::numeric_limits<double>::quiet_NaN();
  double difference = std::numeric_limits<double>::quiet_NaN();  ///< `extrapolated` less the reference
};
Trend trend_of(const std::vector<ComparedModel>& levels, const output::Scalar& number);

/// Notes and warnings that the reader of these levels needs, one line each.
std::vector<std::string> notes_on(const scenario::Scenario& scenario, const std::vector<ComparedModel>& levels);

}  // namespace slipfront::run
