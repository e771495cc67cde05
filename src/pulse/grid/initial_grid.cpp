#include "pulse/grid/initial_grid.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "foundation/math/interval.hpp"
#include "pulse/grid/layout.hpp"

namespace slipfront::pulse {

using std::numbers::pi;

InitialGrid::InitialGrid(const Problem& problem, const Cells& at_start, FreeEdges free_edges)
    : faces{at_start.left_edge()}, charges{0}, free(free_edges), stress(problem.stress) {
  for (std::size_t i = 0; i < at_start.size(); ++i) {
    faces.push_back(faces.back() + at_start.width(i));
    charges.push_back(charges.back() + at_start.charge[i]);
  }
  const auto differs = [&](double x) { return problem.contact(x) != problem.contact(faces.front()); };
  contact_varies = problem.contact && std::any_of(faces.begin(), faces.end(), differs);
}

double InitialGrid::position_of(double charge) const {
  const double rounding = 1e-12 * (charges.back() - charges.front());
  // A dislocation that entered through an end comes from a train with the stress of that end.
  if (charge < charges.front() - rounding)
    return faces.front() + (charge - charges.front()) * 2 * pi / stress(faces.front());
  if (charge > charges.back() + rounding)
    return faces.back() + (charge - charges.back()) * 2 * pi / stress(faces.back());
  const std::size_t i = interval(charges, charge);
  return charge - charges[i] < charges[i + 1] - charge ? faces[i] : faces[i + 1];
}

/// Adds up the whole cells, and integrates the stress over the parts of cells at either end.
double InitialGrid::charge_between(double from, double to) const {
  if (from > to) return -charge_between(to, from);
  const auto beyond = [&](double a, double b, double end) {
    const bool is_free = end == faces.front() ? free.left : free.right;
    return is_free || !(b > a) ? 0 : (b - a) * stress(end) / (2 * pi);
  };
  double sum =
      beyond(from, std::min(to, faces.front()), faces.front()) + beyond(std::max(from, faces.back()), to, faces.back());
  from = std::clamp(from, faces.front(), faces.back());
  to = std::clamp(to, faces.front(), faces.back());
  const std::size_t first = interval(faces, from), last = interval(faces, to);
  const auto part = [&](double a, double b) { return integral(stress, a, b) / (2 * pi); };
  if (first == last) return sum + part(from, to);
  sum += part(from, faces[first + 1]) + part(faces[last], to);
  for (std::size_t i = first + 1; i < last; ++i) sum += charges[i + 1] - charges[i];
  return sum;
}

bool InitialGrid::fits(const Cells& cells, std::size_t state_values) const {
  const std::size_t n = cells.charge.size();
  const double all = charges.back();
  double left = -cells.entered_left;
  bool fits = std::isfinite(left) && std::isfinite(cells.entered_right) && n > 0 && cells.s.size() == n &&
              (cells.face_momentum.empty() || cells.face_momentum.size() == n + 1) &&
              cells.unknowns.size() == Values::size(n) && cells.state.size() == state_values && cells.charge[0] > 0 &&
              cells.charge[n - 1] > 0;
  for (std::size_t i = 0; i < n && fits; ++i) {
    left += cells.charge[i];
    const auto near = std::lower_bound(charges.begin(), charges.end(), left - 1e-9 * all);
    const bool outside = left < -1e-9 * all || left > (1 + 1e-9) * all;  // entered through an end
    fits = cells.charge[i] >= 0 && (outside || (near != charges.end() && *near <= left + 1e-9 * all));
  }
  return fits && std::fabs(left - all - cells.entered_right) <= 1e-9 * (all + std::fabs(cells.entered_right));
}

}  // namespace slipfront::pulse
