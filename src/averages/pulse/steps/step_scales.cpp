#include "averages/pulse/steps/step_scales.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "averages/pulse/grid/cells.hpp"
#include "averages/pulse/time/integrators.hpp"
#include "math/digits.hpp"

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

using std::numbers::pi;

double StepScales::unseen_push(const Cells& cells, double dt) const {
  if (!problem_.forcing) return 0;
  constexpr double last = Ssprk54::last_stage;
  const std::size_t stride = std::max<std::size_t>(cells.size() / 64, 1);
  const double before = cells.time + (2 * last - 1) * dt, stage = cells.time + last * dt, end = cells.time + dt;
  double missed = 0, largest = 0, left = cells.left_edge();  // the face left of cell `counted`
  std::size_t counted = 0;
  for (std::size_t i = 0; i < cells.size(); i += stride) {
    if (cells.charge[i] == 0) continue;
    for (; counted < i; ++counted) left += cells.width(counted);
    const double x = left + cells.width(i) / 2;
    const double at_stage = problem_.forcing(x, stage), at_end = problem_.forcing(x, end);
    const double expected = 2 * at_stage - problem_.forcing(x, before);
    missed = std::fmax(missed, 2 * pi * (1 - last) * dt * std::fabs(at_end - expected));
    const double pushed = 2 * pi * dt * std::fmax(std::fabs(at_stage), std::fabs(at_end));
    largest = std::fmax(largest, std::fmax(pushed, std::fabs(cells.momentum(i) / cells.charge[i])));
  }
  return largest > 0 ? missed / largest : 0;
}

double StepScales::mean_speed(const Cells& cells) const {
  if (cells.time == 0) return 0;
  const std::size_t stride = std::max<std::size_t>(cells.size() / 64, 1);
  double x = cells.left_edge(), charge = -cells.entered_left, way = 0;
  for (std::size_t f = 0; f < cells.size(); ++f) {
    if (f % stride == 0) way = std::fmax(way, std::fabs(x - initial_.position_of(charge)));
    x += cells.width(f);
    charge += cells.charge[f];
  }
  return way / cells.time;
}

/// Momenta are measured by the largest, or at rest by what the pressure soon makes of the densest cell: a sparse cell
/// is pushed by its neighbours. What is slower by a thousandth than the mean so far, as after a push that has ended,
/// adds nothing to slip; and the forces of a contact profile are differences of numbers of size 1.
void StepScales::find_scale(const Cells& cells, const Semidiscrete& equations, double crossing,
                            std::vector<double>& scale) const {
  const double rate = equations.largest_friction_rate();
  const double damping = rate > 0 ? rate * crossing : 0;  // waves may never cross a cell: 0 times infinity
  double fastest = 8e-3 * *std::max_element(equations.s().begin(), equations.s().end()) / (1 + damping);
  constexpr double slow = 8e-3, rounding = 1e-8;
  if (!cells.face_momentum.empty() || takes_friction_by_cells(problem_))
    fastest = std::fmax(fastest, slow * mean_speed(cells));
  if (initial_.contact_varies) fastest = std::fmax(fastest, rounding / (1 + rate));
  for (std::size_t i = 0; i < cells.size(); ++i)
    if (cells.charge[i] > 0) fastest = std::fmax(fastest, std::fabs(cells.momentum(i) / cells.charge[i]));
  for (std::size_t i = 0; i < cells.size(); ++i) {
    scale[i] = cells.width(i);
    scale[cells.size() + i] = cells.charge[i] > 0 ? std::fmax(cells.charge[i] * fastest, smallest_scale) : 1;
  }
}

}  // namespace slipfront::pulse
