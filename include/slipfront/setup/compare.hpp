#pragma once
/// \file
/// The three levels of one model on one scenario, side by side: what `slipfront compare` runs and says.

#include <cstddef>
#include <functional>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "slipfront/chain/run.hpp"
#include "slipfront/pulse/run.hpp"
#include "slipfront/scenario/scenario.hpp"

namespace slipfront::setup {

/// One level, as far as it was run.
struct Level {
  std::string name;  ///< "closed-form", "pulse-consistent", "pulse-paper", "chain-1000"
  std::string closure = {};
  std::optional<double> scale = {};          ///< of a chain
  std::optional<double> window = {};         ///< of a chain: of the slip at x = 0
  std::optional<double> smooth_window = {};  ///< of a chain: of velocities and stresses
  std::vector<pulse::Snapshot> snapshots = {};
  std::vector<std::string> warnings = {};  ///< of the run, a sentence each
  double wall_seconds = 0;
};

/// What there is to run, laid out and checked.
struct Comparison {
  pulse::Problem problem;
  pulse::Schedule schedule;
  std::optional<Level> exact;  ///< the closed form, where there is one
  std::vector<chain::ScaledProblem> chains;
  std::size_t levels() const { return chains.size() + (exact ? 3 : 2); }
};

/// `scales` of the chains; empty: the scenario's, or 100, 300, 1000. \throws InputError for a scale that is not > 0 or
/// is there twice, and for what is wrong with any level: it is known before the work.
Comparison comparison_of(scenario::Scenario scenario, std::vector<double> scales);

/// Runs the levels that are missing, in order, and appends each to `levels` when it is done; before each, `next`.
/// `after_step` (level, its time, its steps) may stop it all by returning true. Returns whether the end was reached.
/// \throws NumericsError that names the level.
bool run_levels(const Comparison& comparison, int threads, std::vector<Level>& levels,
                const std::function<void()>& next,
                const std::function<bool(const std::string& level, double time, long steps)>& after_step);

/// The closed form over the same output grid: the exact Riemann problem (Eqs. 8-10 where the right side is empty).
/// Nothing where there is none: friction, forcing, a contact profile, no step, or waves that reach an end of the
/// domain.
std::optional<Level> closed_form(const scenario::Scenario& scenario, const pulse::Schedule& schedule);

/// A quantity that the levels are compared by, at the end of the run.
struct Quantity {
  const char* key;
  const char* heading;  ///< of a column
  double (*get)(const pulse::Snapshot&);
};
const std::vector<Quantity>& compared_quantities();

/// The level that the others are measured from: pulse, closure consistent.
const Level* reference_level(const std::vector<Level>& levels);

/// How the chain's difference from the reference changes with scale. NaN: cannot be told.
struct Trend {
  /// Least squares of ln |difference| against ln scale, sign turned: 1 where it falls as 1 / scale. Needs two scales.
  double exponent = std::numeric_limits<double>::quiet_NaN();
  /// To infinite scale, from the two largest, by the law 1 / scale.
  double extrapolated = std::numeric_limits<double>::quiet_NaN();
  double difference = std::numeric_limits<double>::quiet_NaN();  ///< of that from the reference
};
Trend trend_of(const std::vector<Level>& levels, const Quantity& quantity);

/// What a reader has to know of these levels, a line each.
std::vector<std::string> notes_on(const scenario::Scenario& scenario, const std::vector<Level>& levels);

}  // namespace slipfront::setup
