#include "front_computed.hpp"

#include <algorithm>
#include <cmath>

#include "observed.hpp"
#include "slipfront/error.hpp"
#include "slipfront/friction/ratio/table.hpp"

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

/// The median of the stress drops of a few coarse runs, for damping numbers at which closure "paper" is unstable. The
/// instability hardly affects coarse runs.
FrontAndDrops drops_of_coarse_runs(Question question) {
  std::array<std::vector<double>, front_layout::drops> found;
  for (const int cells : {150, 210, 270}) {
    question.cells = cells;
    try {
      const FrontAndDrops run = from_solver(question, {});
      for (std::size_t d = 0; d < found.size(); ++d) found[d].push_back(run.drops[d]);
    } catch (const NumericsError&) {
    }
  }
  if (found[0].empty()) throw NumericsError("all runs with closure paper failed");
  return {{}, {median(found[0]), median(found[1])}};
}

/// With closure "paper" some runs with many cells fail. Its instability starts at the leading edge and hardly affects
/// the observed front, so we need no median there. High stresses need more cells.
FrontAndDrops by_paper(double stress, double damping, const std::vector<double>& thresholds) {
  for (const int cells : {stress > 1 && !thresholds.empty() ? 640 : 400, 360, 330}) try {
      return from_solver({stress, damping, Closure::paper, cells}, thresholds);
    } catch (const NumericsError&) {
    }
  return from_solver({stress, damping, Closure::paper, 300}, thresholds);
}

}  // namespace

FrontAndDrops front_and_drops(Closure closure, double stress, double damping, const std::vector<double>& thresholds) {
  if (damping == 0) return without_friction(stress, thresholds);
  if (uncertainty(closure, damping) > 1e-3 && thresholds.empty())
    return drops_of_coarse_runs({stress, damping, closure});
  if (closure == Closure::paper) return by_paper(stress, damping, thresholds);
  // A low threshold needs many cells, unless the front has left the trailing edge.
  return from_solver({stress, damping, closure, damping < 1000 && !thresholds.empty() ? 1600 : 800}, thresholds);
}

}  // namespace slipfront::friction_ratio
