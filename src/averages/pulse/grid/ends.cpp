#include "averages/pulse/grid/ends.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "math/digits.hpp"
#include "slipfront/error.hpp"
#include "slipfront/theory/modulation/modulation.hpp"
#include "slipfront/theory/train.hpp"

namespace slipfront::pulse {

double gaps_close_in(const Problem& problem, const Cells& cells, const double* rates) {
  const ConstValues rate(rates, cells.size());
  double least = HUGE_VAL;
  if (problem.left_end == End::fixed && rate.left_edge() < 0)
    least = std::fmax((problem.left - cells.left_edge()) / rate.left_edge(), 0.0);
  if (problem.right_end == End::fixed) {
    double speed = rate.left_edge();
    for (std::size_t i = 0; i < cells.size(); ++i) speed += rate.width(i);
    if (speed > 0) least = std::fmin(least, std::fmax((problem.right - cells.left_face(cells.size())) / speed, 0.0));
  }
  if (least == 0) least = HUGE_VAL;  // at the wall
  for (std::size_t i = 0; i < cells.size(); ++i)
    if (cells.charge[i] == 0 && rate.width(i) < 0) least = std::fmin(least, -cells.width(i) / rate.width(i));
  return least;
}

namespace {

/// Whether the edges of a gap have met, to a millionth of the cells next to it.
bool gap_has_closed(const Cells& cells, std::size_t i) {
  return cells.charge[i] == 0 && cells.width(i) <= 1e-6 * std::fmin(cells.width(i - 1), cells.width(i + 1));
}

/// Cells next to a closed gap become neighbours. Cells are small at free edges; in the dense state that grows where two
/// edges have met they would only shorten the steps, and are joined.
void close_gap(Cells& cells, std::size_t i) {
  cells.width(i - 1) += cells.width(i) / 2;
  cells.width(i + 1) += cells.width(i) / 2;
  cells.width(i) = 0;
  cells.erase(i);
  std::vector<double> sorted = cells.charge;
  const auto middle = sorted.begin() + static_cast<std::ptrdiff_t>(sorted.size() / 2);
  std::nth_element(sorted.begin(), middle, sorted.end());
  const double enough = 0.4 * *middle;
  const auto small = [&](std::size_t j) { return cells.charge[j] > 0 && cells.charge[j] < enough; };
  for (std::size_t j = i; j < cells.size() && small(j); ++j)
    while (small(j) && j + 1 < cells.size() && cells.charge[j + 1] > 0) cells.join(j + 1, j);
  std::size_t j = i;
  while (j > 0 && small(j - 1)) {
    --j;
    while (small(j) && j > 0 && cells.charge[j - 1] > 0) {
      cells.join(j - 1, j);
      --j;  // the index of the joined cell
    }
  }
}

}  // namespace

/// Closes gaps from right to left. The first and the last cell are never gaps: layout and saved runs begin and end with
/// stress, and no end drops a cell next to a gap.
bool close_gaps(Cells& cells) {
  bool closed = false;
  for (std::size_t i = cells.size() - 1; i-- > 1;) {
    if (!gap_has_closed(cells, i)) continue;
    close_gap(cells, i);
    i = std::min(i, cells.size() - 1);  // joining may have removed cells on both sides
    closed = true;
  }
  if (closed) cells.face_momentum.clear();
  return closed;
}

namespace {

constexpr std::size_t fewest = 8;   ///< cells are removed only while more than this remain
constexpr std::size_t reach = 3;    ///< cells outside a continued end that the faces inside need
constexpr int most_at_once = 5000;  ///< most cells that may enter after one step; waves never need as many

double energy_in(const Problem& problem, const Cells& cells, std::size_t cell) {
  const double x = cells.centre(cell), a = problem.contact ? problem.contact(x) : 1;
  const double q = cells.charge[cell], width = cells.width(cell);
  const State state = modulation::state_of({a * width / q, cells.momentum(cell) / (a * q)}, std::atanh(cells.s[cell]));
  return train::averages(state, a).H * width;
}

/// Adds a copy of the last cell, because the train outside is the same as at the end of the domain.
void fill_end(const Problem& problem, Cells& cells, bool left) {
  const Cells::Cell last = cells.cell(left ? 0 : cells.size() - 1);
  cells.insert(left ? 0 : cells.size(), last);
  if (!cells.face_momentum.empty()) {  // the face at an end has only half a cell around it
    double& half = left ? cells.face_momentum.front() : cells.face_momentum.back();
    const double outer = half;
    half *= 2;
    cells.face_momentum.insert(left ? cells.face_momentum.begin() : cells.face_momentum.end(), outer);
  }
  (left ? cells.entered_left : cells.entered_right) += last.charge;
  if (left) cells.left_edge() -= last.width;
  cells.values().through_ends() += energy_in(problem, cells, left ? 0 : cells.size() - 1);
}

/// Removes the last cell at one end, which is outside the domain.
void drop_outside(const Problem& problem, Cells& cells, bool left) {
  const std::size_t end = left ? 0 : cells.size() - 1;
  const double width = cells.width(end);
  cells.values().through_ends() -= energy_in(problem, cells, end);
  (left ? cells.entered_left : cells.entered_right) -= cells.charge[end];
  if (!cells.face_momentum.empty()) {
    const std::size_t next = left ? 1 : cells.size() - 1;
    const double around = cells.charge[next] + cells.charge[next - 1], inside = cells.charge[left ? 1 : end - 1];
    cells.face_momentum[next] *= inside / around;
    cells.face_momentum.erase(left ? cells.face_momentum.begin() : cells.face_momentum.end() - 1);
  }
  cells.erase(end);
  if (left) cells.left_edge() += width;
}

/// Stops a free edge at the wall when it returns there.
void stop_at_walls(const Problem& problem, Cells& cells) {
  double& x = cells.left_edge();
  const double near = 1e-6;  // fraction of a cell within which an edge counts as at the wall
  if (problem.left_end == End::fixed && x < problem.left + near * cells.width(0)) {
    cells.width(0) -= problem.left - x;
    x = problem.left;
  }
  if (problem.right_end != End::fixed) return;
  double& last = cells.width(cells.size() - 1);
  const double beyond = cells.left_face(cells.size()) - problem.right;
  if (beyond > -near * last) last -= beyond;
}

}  // namespace

bool adjust_ends(const Problem& problem, FreeEdges free, Cells& cells) {
  if (problem.periodic) return false;
  bool changed = false;
  for (const bool left : {true, false}) {
    const End end = left ? problem.left_end : problem.right_end;
    if (end == End::fixed) continue;
    const bool continued = end == End::continued;
    if (continued && (left ? free.left : free.right)) continue;  // the stress ends inside the domain
    const double edge = left ? cells.left_edge() : cells.left_face(cells.size());
    // Rounding moves a train at rest. We do not fill a space narrower than this fraction of a cell.
    const double sliver = continued ? 1e-3 * cells.width(left ? 0 : cells.size() - 1) : 0;
    double inside = (left ? edge - problem.left : problem.right - edge) - sliver;
    for (int i = 0; continued && inside > 0; ++i) {
      if (i == most_at_once)
        throw NumericsError("t = " + digits(cells.time) + ": the train moved away from an end of the domain by " +
                            digits(inside) + " in one step; more cells or a larger domain help");
      fill_end(problem, cells, left);
      changed = true;
      inside -= cells.width(left ? 0 : cells.size() - 1);
    }
    const std::size_t margin = continued ? reach : 0;
    while (cells.size() > fewest + margin) {
      double first = 0;  // total width of the cells that must be outside the domain
      for (std::size_t i = 0; i <= margin; ++i) first += cells.width(left ? i : cells.size() - 1 - i);
      const bool alone = cells.charge[left ? 1 : cells.size() - 2] == 0;
      if (inside + first > 0 || alone) break;
      inside += cells.width(left ? 0 : cells.size() - 1);
      drop_outside(problem, cells, left);
      changed = true;
    }
  }
  stop_at_walls(problem, cells);
  return changed;
}

}  // namespace slipfront::pulse
