#include "pulse/grid/ends.hpp"

#include <cmath>

#include "foundation/text/digits.hpp"
#include "slipfront/error.hpp"
#include "slipfront/modulation/per_dislocation.hpp"
#include "slipfront/train/train.hpp"

namespace slipfront::pulse {
namespace {

constexpr std::size_t fewest = 8;   ///< cells that are kept, wherever they are
constexpr std::size_t reach = 3;    ///< cells beyond a continued end, for the faces inside
constexpr int most_at_once = 5000;  ///< cells that come in after one step; more is no step that waves allow

double energy_in(const Problem& problem, const Cells& cells, std::size_t cell) {
  const double x = cells.centre(cell), a = problem.contact ? problem.contact(x) : 1;
  const double q = cells.charge[cell], width = cells.width(cell);
  const State state = modulation::state_of({a * width / q, cells.momentum(cell) / (a * q)}, std::atanh(cells.s[cell]));
  return train::averages(state, a).H * width;
}

/// The train outside is as it is at the end of the domain: a cell like the last one comes in.
void fill_end(const Problem& problem, Cells& cells, bool left) {
  const Cells::Cell last = cells.cell(left ? 0 : cells.size() - 1);
  cells.insert(left ? 0 : cells.size(), last);
  if (!cells.face_momentum.empty()) {  // around the face at an end there is half a cell
    double& half = left ? cells.face_momentum.front() : cells.face_momentum.back();
    const double outer = half;
    half *= 2;
    cells.face_momentum.insert(left ? cells.face_momentum.begin() : cells.face_momentum.end(), outer);
  }
  (left ? cells.entered_left : cells.entered_right) += last.charge;
  if (left) cells.left_edge() -= last.width;
  cells.values().through_ends() += energy_in(problem, cells, left ? 0 : cells.size() - 1);
}

/// Removes the last cell, which is outside the domain.
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

/// A free edge that comes back to a wall stops there.
void stop_at_walls(const Problem& problem, Cells& cells) {
  double& x = cells.left_edge();
  const double near = 1e-6;  // of a cell, as where a gap closes
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
    // A train at rest moves by rounding: a sliver is no place that has to be filled.
    const double sliver = continued ? 1e-3 * cells.width(left ? 0 : cells.size() - 1) : 0;
    double inside = (left ? edge - problem.left : problem.right - edge) - sliver;
    for (int i = 0; continued && inside > 0; ++i) {
      if (i == most_at_once)
        throw NumericsError("t = " + digits(cells.time) + ": the train has left an end of the domain by " +
                            digits(inside) + " in a step; more pulse.cells or a larger domain help");
      fill_end(problem, cells, left);
      changed = true;
      inside -= cells.width(left ? 0 : cells.size() - 1);
    }
    const std::size_t margin = continued ? reach : 0;
    while (cells.size() > fewest + margin) {
      double first = 0;  // width of the cells that must lie beyond
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
