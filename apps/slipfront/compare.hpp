#pragma once

#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "slipfront/pulse/snapshot.hpp"
#include "slipfront/scenario/scenario.hpp"

/// The three levels of one model on one scenario, side by side: what `slipfront compare` runs and says.

/// One level, as far as it was run.
struct Level {
  std::string name;  ///< "closed-form", "pulse-consistent", "pulse-paper", "chain-1000"
  std::string closure = {};
  std::optional<double> scale = {};          ///< of a chain
  std::optional<double> window = {};         ///< of a chain: of the slip at x = 0
  std::optional<double> smooth_window = {};  ///< of a chain: of velocities and stresses
  std::vector<slipfront::pulse::Snapshot> snapshots = {};
  double wall_seconds = 0;
};

/// The closed form over the same output grid: the exact Riemann problem (Eqs. 8-10 where the right side is empty).
/// Nothing where there is none: friction, forcing, a contact profile, no step, or waves that reach an end of the
/// domain.
std::optional<Level> closed_form(const slipfront::scenario::Scenario& scenario,
                                 const slipfront::pulse::Schedule& schedule);

/// A quantity that the levels are compared by, at the end of the run.
struct Quantity {
  const char* key;
  const char* heading;  ///< of a column
  double (*get)(const slipfront::pulse::Snapshot&);
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
std::vector<std::string> notes_on(const slipfront::scenario::Scenario& scenario);

/// As a table or as one JSON object, on stdout.
void print_comparison(const slipfront::scenario::Scenario& scenario, const std::vector<Level>& levels, bool json);
