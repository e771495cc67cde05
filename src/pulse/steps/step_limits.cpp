#include "pulse/steps/step_limits.hpp"

#include <cmath>

#include "foundation/text/digits.hpp"
#include "pulse/grid/values.hpp"

namespace slipfront::pulse {

NumericsError too_strong_forces(double time) {
  return NumericsError("t = " + digits(time) +
                       ": the time step failed: the forces on a cell exceed what any step can resolve");
}

bool cells_jump(const std::vector<double>& before, const std::vector<double>& after,
                const std::vector<double>& charge) {
  const ConstValues was(before.data(), charge.size()), is(after.data(), charge.size());
  for (std::size_t i = 0; i < charge.size(); ++i) {
    const double M = was.momentum(i);
    if (std::fabs(is.momentum(i) - M) > 4 * charge[i] + std::fabs(M) / 2) return true;
    if (charge[i] > 0 && !(is.width(i) > was.width(i) / 10)) return true;
  }
  return false;
}

}  // namespace slipfront::pulse
