// What happens at the ends of the domain: dislocations come in, leave, or stop at a wall.

#include <cmath>

#include "foundation/text/digits.hpp"
#include "slipfront/error.hpp"
#include "slipfront/pulse/solver.hpp"

namespace slipfront::pulse {
namespace {

constexpr std::size_t fewest = 8;   ///< cells that are kept, wherever they are
constexpr std::size_t reach = 3;    ///< cells beyond a continued end, for the faces inside
constexpr int most_at_once = 5000;  ///< cells that come in after one step; more is no step that waves allow

}  // namespace

double Solver::left_face(std::size_t cell) const {
  double x = cells_.left_edge();
  for (std::size_t i = 0; i < cell; ++i) x += cells_.width(i);
  return x;
}

/// A train that goes on beyond the end is as it is at the end: a cell like the last one comes in.
void Solver::fill_end(bool left) {
  const std::size_t n = size(), end = left ? 0 : n - 1;
  const double charge = cells_.charge[end], width = cells_.width(end), momentum = cells_.momentum(end),
               s = cells_.s[end];
  const auto at = [&](std::size_t i) { return static_cast<std::ptrdiff_t>(i); };
  const std::size_t where = left ? 0 : n;
  cells_.unknowns.insert(cells_.unknowns.begin() + at(n + where), momentum);
  cells_.unknowns.insert(cells_.unknowns.begin() + at(where), width);
  cells_.charge.insert(cells_.charge.begin() + at(where), charge);
  cells_.s.insert(cells_.s.begin() + at(where), s);
  if (!cells_.face_momentum.empty()) {  // around the face at an end there is half a cell
    double& half = left ? cells_.face_momentum.front() : cells_.face_momentum.back();
    const double outer = half;
    half *= 2;
    cells_.face_momentum.insert(left ? cells_.face_momentum.begin() : cells_.face_momentum.end(), outer);
  }
  (left ? cells_.entered_left : cells_.entered_right) += charge;
  if (left) cells_.left_edge() -= width;
  cells_.values().through_ends() += energy_in(left ? 0 : size() - 1);
}

/// What is beyond the end no longer counts.
void Solver::drop_beyond(bool left) {
  const std::size_t end = left ? 0 : size() - 1;
  const double width = cells_.width(end);
  cells_.values().through_ends() -= energy_in(end);
  (left ? cells_.entered_left : cells_.entered_right) -= cells_.charge[end];
  if (!cells_.face_momentum.empty()) {
    const std::size_t next = left ? 1 : size() - 1;
    const double around = cells_.charge[next] + cells_.charge[next - 1], inside = cells_.charge[left ? 1 : end - 1];
    cells_.face_momentum[next] *= inside / around;
    cells_.face_momentum.erase(left ? cells_.face_momentum.begin() : cells_.face_momentum.end() - 1);
  }
  drop_cell(end);
  if (left) cells_.left_edge() += width;
}

/// A free edge that comes back to a wall stops there.
void Solver::stop_at_walls() {
  double& x = cells_.left_edge();
  const double near = 1e-6;  // of a cell, as where a gap closes
  if (problem_.left_end == End::fixed && x < problem_.left + near * cells_.width(0)) {
    cells_.width(0) -= problem_.left - x;
    x = problem_.left;
  }
  if (problem_.right_end != End::fixed) return;
  double& last = cells_.width(size() - 1);
  const double beyond = left_face(size()) - problem_.right;
  if (beyond > -near * last) last -= beyond;
}

void Solver::adjust_ends() {
  if (problem_.periodic) return;
  bool changed = false;
  for (const bool left : {true, false}) {
    const End end = left ? problem_.left_end : problem_.right_end;
    if (end == End::fixed) continue;
    const bool continued = end == End::continued;
    if (continued && (left ? left_free_ : right_free_)) continue;  // the stress ends inside the domain
    const double edge = left ? cells_.left_edge() : left_face(size());
    // A train at rest moves by rounding: a sliver is no place that has to be filled.
    const double sliver = continued ? 1e-3 * cells_.width(left ? 0 : size() - 1) : 0;
    double inside = (left ? edge - problem_.left : problem_.right - edge) - sliver;
    for (int i = 0; continued && inside > 0; ++i) {
      if (i == most_at_once)
        throw NumericsError("t = " + digits(cells_.time) + ": the train has left an end of the domain by " +
                            digits(inside) + " in a step; more pulse.cells or a larger domain help");
      fill_end(left);
      changed = true;
      inside -= cells_.width(left ? 0 : size() - 1);
    }
    const std::size_t margin = continued ? reach : 0;
    while (size() > fewest + margin) {
      double first = 0;  // width of the cells that must lie beyond
      for (std::size_t i = 0; i <= margin; ++i) first += cells_.width(left ? i : size() - 1 - i);
      const bool alone = cells_.charge[left ? 1 : size() - 2] == 0;
      if (inside + first > 0 || alone) break;
      inside += cells_.width(left ? 0 : size() - 1);
      drop_beyond(left);
      changed = true;
    }
  }
  stop_at_walls();
  if (changed) lay_equations();
}

}  // namespace slipfront::pulse
