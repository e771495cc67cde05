#include "front_computed.hpp"

#include <algorithm>
#include <cmath>

#include "friction_ratio/observed.hpp"
#include "slipfront/error.hpp"
#include "slipfront/friction_ratio/table.hpp"

namespace slipfront::friction_ratio {

namespace {

using friction::Closure;

FrontAndDrops from_solver(const Question& question, const std::vector<double>& thresholds) {
  const Pulse pulse = solve_pulse(question);
  FrontAndDrops found;
  for (const double threshold : thresholds) found.fronts.push_back(observed_front(pulse, question.stress, threshold));
  const DropShares drops = observed_drops(pulse, question.stress);
  found.drops = {drops.origin, drops.mean};
  return found;
}

FrontAndDrops without_friction(double stress, const std::vector<double>& thresholds) {
  FrontAndDrops found;
  for (const double threshold : thresholds) found.fronts.push_back(frictionless_front(stress, threshold));
  const DropShares drops = frictionless_drops(stress);
  found.drops = {drops.origin, drops.mean};
  return found;
}

double median(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  return values[values.size() / 2];
}

/// The median of a few coarse runs, for damping numbers at which closure "paper" is unstable.
FrontAndDrops median_of_coarse_runs(Question question, const std::vector<double>& thresholds) {
  std::vector<FrontAndDrops> runs;
  for (const int cells : {120, 150, 180, 210, 240, 270, 300}) {
    question.cells = cells;
    try {
      runs.push_back(from_solver(question, thresholds));
    } catch (const NumericsError&) {
    }
  }
  if (runs.empty()) throw NumericsError("all runs with closure paper failed");
  const auto median_of = [&](auto number) {
    std::vector<double> values;
    for (const FrontAndDrops& run : runs) values.push_back(number(run));
    return median(values);
  };
  FrontAndDrops found;
  for (std::size_t t = 0; t < thresholds.size(); ++t)
    found.fronts.push_back(median_of([t](const FrontAndDrops& run) { return run.fronts[t]; }));
  for (std::size_t d = 0; d < front_layout::drops; ++d)
    found.drops[d] = median_of([d](const FrontAndDrops& run) { return run.drops[d]; });
  return found;
}

/// Closure "paper" gains nothing from more cells than these, and some runs with 400 cells fail.
FrontAndDrops by_paper(double stress, double damping, const std::vector<double>& thresholds) {
  for (const int cells : {400, 360, 330}) try {
      return from_solver({stress, damping, Closure::paper, cells}, thresholds);
    } catch (const NumericsError&) {
    }
  return from_solver({stress, damping, Closure::paper, 300}, thresholds);
}

}  // namespace

FrontAndDrops front_and_drops(Closure closure, double stress, double damping, const std::vector<double>& thresholds) {
  if (damping == 0) return without_friction(stress, thresholds);
  if (uncertainty(closure, damping) > 1e-3) return median_of_coarse_runs({stress, damping, closure}, thresholds);
  if (closure == Closure::paper) return by_paper(stress, damping, thresholds);
  // A low threshold needs many cells, unless the front has left the trailing edge.
  return from_solver({stress, damping, closure, damping < 1000 && !thresholds.empty() ? 1600 : 800}, thresholds);
}

}  // namespace slipfront::friction_ratio
