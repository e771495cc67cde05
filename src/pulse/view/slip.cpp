#include "pulse/view/slip.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "foundation/math/interval.hpp"
#include "foundation/math/lagrange.hpp"

namespace slipfront::pulse {
namespace {

using std::numbers::pi;

/// Lagrange interpolation through four points. If they are not smooth on the grid, it is linear between the middle two,
/// and limited to the range of the outer two elsewhere.
double cubic(const double* x, const double* f, double at) {
  const double sum = lagrange(4, x, f, at);
  const auto slope = [&](std::size_t j) { return (f[j + 1] - f[j]) / (x[j + 1] - x[j]); };
  const double bend = slope(1) - slope(0), next_bend = slope(2) - slope(1);
  if (std::fabs(next_bend - bend) < 0.7 * (std::fabs(bend) + std::fabs(next_bend))) return sum;
  const double line = f[1] + (f[2] - f[1]) * (at - x[1]) / (x[2] - x[1]);
  return at > x[1] && at < x[2] ? line : std::clamp(sum, std::min(f[0], f[3]), std::max(f[0], f[3]));
}

/// Density k half way between a face and x. At a face where a train meets a much more dilute one, k belongs to neither.
double density_between(const View& v, double face, double x) {
  const double middle = (face + x) / 2;
  return averages_of(v, state_at(v, middle), middle).k;
}

/// Distance that the dislocation at x, inside a cell, has moved since t = 0.
double way_at(const InitialGrid& initial, const Cells& cells, const View& v, std::size_t cell, double x) {
  constexpr double unresolved = 0.25;  // distance, in cells, above which the pulse is resolved
  const auto way = [&](std::size_t f) { return v.faces[f] - initial.position_of(v.charge_faces[f]); };
  const std::size_t near = x - v.faces[cell] < v.faces[cell + 1] - x ? cell : cell + 1;
  const double width = v.faces[cell + 1] - v.faces[cell], aside = x - v.faces[near];
  const double come = std::fabs(way(near));
  if (come < width && std::fabs(aside) <= 2 * come) {
    // The pulse may be narrower than the cell, because x is within twice the distance that the face has moved. We use
    // the densities near the face, and also the distance that the other face has moved if the pulse is resolved.
    const double at_face = 2 * pi * v.face_density[near], beside = density_between(v, v.faces[near], x);
    const bool jump = std::fmax(at_face, beside) > 2 * std::fmin(at_face, beside);
    const bool resolved = come >= unresolved * width && !jump;
    // Initial stress next to the initial position of the face, on the side of x. If the pulse is not resolved, we take
    // the stress half way to x.
    const double before = initial.stress(v.faces[near] - way(near) + (resolved ? 1e-6 : 0.5) * aside);
    const double slope = before > 0 ? 1 - (jump ? beside : at_face) / before : 0;
    const std::size_t other = near == cell ? cell + 1 : cell;
    const double apart = v.faces[other] - v.faces[near], mean_slope = (way(other) - way(near)) / apart;
    const double bend = resolved ? (mean_slope - slope) / apart : 0;
    return way(near) + aside * (slope + bend * aside);
  }
  const std::size_t n = v.states.size();
  const bool inside = cell > 0 && cell + 1 < n && cells.charge[cell - 1] > 0 && cells.charge[cell + 1] > 0;
  if (!inside) return std::lerp(way(cell), way(cell + 1), (x - v.faces[cell]) / width);
  const double ways[4] = {way(cell - 1), way(cell), way(cell + 1), way(cell + 2)};
  return cubic(&v.faces[cell - 1], ways, x);
}

/// Initial position of the dislocation that is now at x.
double start_of(const InitialGrid& initial, const Cells& cells, const View& v, double x) {
  if (x <= v.faces.front()) return initial.position_of(v.charge_faces.front());
  if (x >= v.faces.back()) return initial.position_of(v.charge_faces.back());
  const std::size_t cell = interval(v.faces, x);
  const bool gap = cells.charge[cell] == 0;  // no dislocations between its edges
  return gap ? initial.position_of(v.charge_faces[cell]) : x - way_at(initial, cells, v, cell, x);
}

}  // namespace

double slip_at(const InitialGrid& initial, const Cells& cells, const View& v, double place) {
  const double x = v.period > 0 ? place - std::floor((place - v.faces.front()) / v.period) * v.period : place;
  return 2 * pi * initial.charge_between(start_of(initial, cells, v, x), x);
}

}  // namespace slipfront::pulse
