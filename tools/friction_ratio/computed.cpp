#include "computed.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "slipfront/error.hpp"
#include "slipfront/friction/ratio/table.hpp"
#include "slipfront/theory/rupture/relations.hpp"

namespace slipfront::friction_ratio {

namespace {

using friction::Closure;

Logarithms logarithms(const Question& question) {
  const SlipVelocities w = solve(question);
  const double unit = rupture::from_stress(question.stress).slip_velocity;
  return {std::log(w.origin / unit), std::log(w.mean / unit), std::log(w.peak / unit), std::log(w.time_mean / unit)};
}

/// The median of a few coarse runs, for damping numbers at which closure "paper" is unstable. The instability hardly
/// affects coarse runs.
Logarithms median_of_coarse_runs(Question question) {
  std::vector<Logarithms> found;
  for (const int cells : {120, 150, 180, 210, 240, 270, 300}) {
    question.cells = cells;
    try {
      const Logarithms v = logarithms(question);
      if (std::isfinite(v[0] + v[1] + v[2] + v[3])) found.push_back(v);
    } catch (const NumericsError&) {
    }
  }
  if (found.empty()) throw NumericsError("all runs with closure paper failed");
  Logarithms median{};
  for (std::size_t m = 0; m < layout::measures; ++m) {
    std::sort(found.begin(), found.end(), [m](const Logarithms& a, const Logarithms& b) { return a[m] < b[m]; });
    median[m] = found[found.size() / 2][m];
  }
  return median;
}

/// Number of cells for which the error of the solver is below 3e-5. It is larger near the switch to implicit steps, and
/// below Gamma = 30, where errors at high stress are largest.
int cells_for(double damping) { return damping < 30 || (damping >= 1000 && damping < 1e5) ? 800 : 400; }

/// Values for closure "paper". With 800 cells its instability would cost more than the resolution gains, and some runs
/// with 400 cells fail (docs/friction_ratio.md).
Logarithms by_paper(double stress, double damping) {
  for (const int cells : {400, 360, 330}) try {
      return logarithms({stress, damping, Closure::paper, cells});
    } catch (const NumericsError&) {
    }
  return logarithms({stress, damping, Closure::paper, 300});
}

}  // namespace

Logarithms computed(Closure closure, double stress, double damping) {
  if (uncertainty(closure, damping) > 1e-3) return median_of_coarse_runs({stress, damping, closure});
  Logarithms values = closure == Closure::paper ? by_paper(stress, damping)
                                                : logarithms({stress, damping, closure, cells_for(damping)});
  if (damping == 0) values[0] = values[3] = 0;
  return values;
}

}  // namespace slipfront::friction_ratio
