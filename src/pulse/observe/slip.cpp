// Slip from the way that dislocations have come.

#include <algorithm>
#include <cmath>
#include <numbers>

#include "foundation/math/lagrange.hpp"
#include "pulse/grid/interval.hpp"
#include "pulse/grid/layout.hpp"
#include "slipfront/pulse/solver.hpp"

namespace slipfront::pulse {
namespace {

using std::numbers::pi;

/// Lagrange through four points, but no farther than the middle two where these are not smooth on the grid.
double cubic(const double* x, const double* f, double at) {
  const double sum = lagrange(4, x, f, at);
  const auto slope = [&](std::size_t j) { return (f[j + 1] - f[j]) / (x[j + 1] - x[j]); };
  const double bend = slope(1) - slope(0), next_bend = slope(2) - slope(1);
  if (std::fabs(next_bend - bend) < 0.7 * (std::fabs(bend) + std::fabs(next_bend))) return sum;
  const double line = f[1] + (f[2] - f[1]) * (at - x[1]) / (x[2] - x[1]);
  return at > x[1] && at < x[2] ? line : std::clamp(sum, std::min(f[0], f[3]), std::max(f[0], f[3]));
}

/// k half way from a face to a place near it. Where a train ends at one that hardly pushes, k at the face is neither's.
double density_between(const Solver::View& v, double face, double x) {
  const double middle = (face + x) / 2;
  return averages_of(v, state_at(v, middle), middle).k;
}

}  // namespace

double Solver::first_place(double charge) const {
  const std::vector<double>&charges = first_.charge_faces, &faces = first_.faces;
  const double rounding = 1e-12 * (charges.back() - charges.front());
  if (charge < charges.front() - rounding)  // came in through an end: the train beyond was as at the end
    return faces.front() + (charge - charges.front()) * 2 * pi / problem_.stress(faces.front());
  if (charge > charges.back() + rounding)
    return faces.back() + (charge - charges.back()) * 2 * pi / problem_.stress(faces.back());
  const std::size_t i = interval(charges, charge);
  return charge - charges[i] < charges[i + 1] - charge ? faces[i] : faces[i + 1];
}

/// Of the initial stress, over 2 pi. Whole cells are known; the parts at either end are integrated.
double Solver::charge_between(double from, double to) const {
  if (from > to) return -charge_between(to, from);
  const std::vector<double>& faces = first_.faces;
  const auto beyond = [&](double a, double b, double end) {
    const bool free = end == faces.front() ? left_free_ : right_free_;
    return free || !(b > a) ? 0 : (b - a) * problem_.stress(end) / (2 * pi);
  };
  double sum =
      beyond(from, std::min(to, faces.front()), faces.front()) + beyond(std::max(from, faces.back()), to, faces.back());
  from = std::clamp(from, faces.front(), faces.back());
  to = std::clamp(to, faces.front(), faces.back());
  const std::size_t first = interval(faces, from), last = interval(faces, to);
  const auto part = [&](double a, double b) { return integral(problem_.stress, a, b) / (2 * pi); };
  if (first == last) return sum + part(from, to);
  sum += part(from, faces[first + 1]) + part(faces[last], to);
  for (std::size_t i = first + 1; i < last; ++i) sum += first_.charge_faces[i + 1] - first_.charge_faces[i];
  return sum;
}

/// Within a cell: how far the dislocation at x has come.
double Solver::way_at(const View& v, std::size_t cell, double x) const {
  constexpr double unresolved = 0.25;  // ways, in cells
  const auto way = [&](std::size_t f) { return v.faces[f] - first_place(v.charge_faces[f]); };
  const std::size_t near = x - v.faces[cell] < v.faces[cell + 1] - x ? cell : cell + 1;
  const double width = v.faces[cell + 1] - v.faces[cell], aside = x - v.faces[near];
  const double come = std::fabs(way(near));
  if (come < width && std::fabs(aside) <= 2 * come) {
    // Nearer to a face than that has come, in a pulse that may be narrower than the cell: from the densities there
    // and, as the pulse grows, the way of the other face.
    const double at_face = 2 * pi * v.face_density[near], beside = density_between(v, v.faces[near], x);
    const bool jump = std::fmax(at_face, beside) > 2 * std::fmin(at_face, beside);
    const bool resolved = come >= unresolved * width && !jump;
    // The stress before on this side of the face, or on the mean over what lies between.
    const double before = problem_.stress(v.faces[near] - way(near) + (resolved ? 1e-6 : 0.5) * aside);
    const double slope = before > 0 ? 1 - (jump ? beside : at_face) / before : 0;
    const std::size_t other = near == cell ? cell + 1 : cell;
    const double apart = v.faces[other] - v.faces[near], mean_slope = (way(other) - way(near)) / apart;
    const double bend = resolved ? (mean_slope - slope) / apart : 0;
    return way(near) + aside * (slope + bend * aside);
  }
  const std::size_t n = v.states.size();
  const bool inside = cell > 0 && cell + 1 < n && cells_.charge[cell - 1] > 0 && cells_.charge[cell + 1] > 0;
  if (!inside) return std::lerp(way(cell), way(cell + 1), (x - v.faces[cell]) / width);
  const double ways[4] = {way(cell - 1), way(cell), way(cell + 1), way(cell + 2)};
  return cubic(&v.faces[cell - 1], ways, x);
}

/// Where the dislocation that is now at x began.
double Solver::start_of(const View& v, double x) const {
  if (x <= v.faces.front()) return first_place(v.charge_faces.front());
  if (x >= v.faces.back()) return first_place(v.charge_faces.back());
  const std::size_t cell = interval(v.faces, x);
  const bool gap = cells_.charge[cell] == 0;  // nothing lies between its edges
  return gap ? first_place(v.charge_faces[cell]) : x - way_at(v, cell, x);
}

double Solver::slip_at(const View& v, double place) const {
  const double x = v.period > 0 ? place - std::floor((place - v.faces.front()) / v.period) * v.period : place;
  return 2 * pi * charge_between(start_of(v, x), x);
}

}  // namespace slipfront::pulse
