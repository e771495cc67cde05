#include "averages/pulse/view/view.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "averages/pulse/space/kernels.hpp"
#include "math/constants.hpp"
#include "math/interpolation.hpp"
#include "slipfront/theory/modulation/modulation.hpp"
#include "slipfront/theory/train.hpp"

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

namespace {

using std::numbers::pi;

/// State at face f from the reconstructed phi and psi, for a face that is no free edge. psi is limited to the range of
/// the two cells next to the face. As at a smooth extremum, it may exceed that range by a quarter of the difference
/// from the next cells, twice the usual eighth.
///
/// psi is half the difference of two invariants. If phi changes from cell to cell by as much as psi, then psi at the
/// face is the pressure of the collision, or rounding. We then take the train at the face from the cells.
State state_between(const std::vector<State>& cells, std::size_t f, double phi, double psi) {
  const std::size_t n = cells.size(), left = f == 0 ? 0 : f - 1, right = f == n ? n - 1 : f;
  const double least = std::fmin(cells[left].psi, cells[right].psi),
               most = std::fmax(cells[left].psi, cells[right].psi);
  double below = 0, above = 0;
  if (left > 0 && right + 1 < n && !cells[left - 1].empty() && !cells[right + 1].empty()) {
    const double before = cells[left - 1].psi, behind = cells[right + 1].psi;
    below = std::fmax(std::fmin(before, behind) - least, 0) / 4;
    above = std::fmax(most - std::fmax(before, behind), 0) / 4;
  }
  constexpr double small = 0.02;
  const double within = std::clamp(psi, least - below, most + above);
  if (std::fabs(psi - within) <= small * within) return {phi, within};
  return {phi, std::sqrt(cells[left].psi) * std::sqrt(cells[right].psi)};
}

/// Number of turns by which x must be moved back on a ring to be among its faces.
double turns(const View& v, double x) { return std::floor((x - v.faces.front()) / v.period); }

/// Centres and faces around x, at most five, in rising order.
struct Nodes {
  double x[5];
  State state[5];
  std::size_t size = 0;

  void add(double place, const State& s) {
    x[size] = place;
    state[size++] = s;
  }
};

/// Whether the train in a cell ends at a face at which a much denser train begins, without a fan of the denser train in
/// the cell. The dilute train then pushes back almost nothing, and its state is uniform up to the face.
bool ends_at(const View& v, std::size_t cell, std::size_t face) {
  constexpr double denser = 100, fan = 0.1, apart = 0.5;
  const State &here = v.states[cell], &beyond = v.states[face == cell ? face - 1 : face];
  if (beyond.empty() || !(beyond.psi > denser * here.psi)) return false;
  return std::fabs(v.face_states[face].phi - (here.phi + beyond.phi) / 2) < fan * beyond.psi &&
         std::fabs(beyond.phi - here.phi) < apart * beyond.psi;
}

/// The centre of the cell, its faces, and the centres of its neighbours in the same block. A step of stress, or a pulse
/// that is still narrower than a cell, appears at a face long before it appears in the cells. Within rounding of the
/// face itself, the states of both sides count equally.
Nodes nodes_around(const View& v, std::size_t cell, double x) {
  Nodes nodes;
  const std::size_t n = v.states.size();
  const double rounding = 1e-9 * (v.faces[cell + 1] - v.faces[cell]);
  const bool left_ends = cell > 0 && x > v.faces[cell] + rounding && ends_at(v, cell, cell);
  const bool right_ends = cell + 1 < n && x < v.faces[cell + 1] - rounding && ends_at(v, cell, cell + 1);
  const auto at_face = [&](std::size_t f, bool ends) {
    nodes.add(v.faces[f], ends ? State{v.face_states[f].phi, v.states[cell].psi} : v.face_states[f]);
  };
  if (cell > 0 && !left_ends && !v.states[cell - 1].empty()) nodes.add(v.centres[cell - 1], v.states[cell - 1]);
  at_face(cell, left_ends);
  nodes.add(v.centres[cell], v.states[cell]);
  at_face(cell + 1, right_ends);
  if (cell + 1 < n && !right_ends && !v.states[cell + 1].empty()) nodes.add(v.centres[cell + 1], v.states[cell + 1]);
  return nodes;
}

/// Whether the curvatures at the first three of four points and at the last three are nearly equal.
bool bends_alike(const double* x, const double* f) {
  const auto slope = [&](std::size_t j) { return (f[j + 1] - f[j]) / (x[j + 1] - x[j]); };
  const double bend = (slope(1) - slope(0)) / (x[2] - x[0]), next = (slope(2) - slope(1)) / (x[3] - x[1]);
  return std::fabs(next - bend) < 0.5 * (std::fabs(bend) + std::fabs(next));
}

/// Value at x of the polynomial through `size` points. If the points are not smooth, the value is limited to the range
/// of the two around x. If they are smooth, it may exceed the range of all by a quarter, as at an extremum.
double bounded(std::size_t size, const double* at, const double* f, double x) {
  const std::size_t next =
      std::clamp<std::size_t>(static_cast<std::size_t>(std::upper_bound(at, at + size, x) - at), 1, size - 1);
  bool smooth = true;
  for (std::size_t j = 0; j + 3 < size; ++j) smooth = smooth && bends_alike(at + j, f + j);
  const double sum = lagrange(size, at, f, x);
  if (!smooth) return std::clamp(sum, std::min(f[next - 1], f[next]), std::max(f[next - 1], f[next]));
  const auto [least, most] = std::minmax_element(f, f + size);
  const double beyond = (*most - *least) / 4;
  return std::clamp(sum, *least - beyond, *most + beyond);
}

}  // namespace

View view_of(const Problem& problem, const Cells& cells, Equations& equations, bool densities) {
  const std::size_t n = cells.size();
  Semidiscrete& semidiscrete = equations.semidiscrete();
  std::vector<double> rate(cells.unknowns.size());
  semidiscrete.start_from(cells.s);
  semidiscrete(cells.time, cells.unknowns.data(), rate.data());
  View v;
  v.faces.resize(n + 1);
  v.charge_faces.resize(n + 1);
  v.faces[0] = cells.left_edge();
  v.charge_faces[0] = -cells.entered_left;
  if (problem.periodic) v.period = problem.right - problem.left;
  for (std::size_t i = 0; i < n; ++i) {
    v.faces[i + 1] = v.faces[i] + cells.width(i);
    v.charge_faces[i + 1] = v.charge_faces[i] + cells.charge[i];
  }
  v.states = semidiscrete.states();
  v.contact = problem.contact;
  v.shocked = semidiscrete.shocked();
  v.left_free = semidiscrete.blocks().front().left == Edge::free;
  v.right_free = semidiscrete.blocks().back().right == Edge::free;
  const std::vector<double>* face_phi = &semidiscrete.face_phi();
  if (!cells.face_momentum.empty()) {  // with strong friction, the momenta at the faces determine the velocities
    Staggered& staggered = equations.staggered(cells);
    staggered.start_from(cells.s);
    std::vector<double> unknowns, face_rate(staggered.size());
    faces_from_cells(cells, staggered, unknowns);
    staggered(cells.time, unknowns.data(), face_rate.data());
    face_phi = &staggered.face_phi();
  }
  for (std::size_t f = 0; f <= n; ++f) {
    const double phi = (*face_phi)[f], psi = semidiscrete.face_psi()[f];
    const bool edge = f == 0 ? v.left_free : f == n ? v.right_free : cells.charge[f - 1] == 0 || cells.charge[f] == 0;
    v.face_states.push_back(edge ? State{phi, psi} : state_between(v.states, f, phi, psi));
  }
  for (std::size_t f = 0; f <= n && densities; ++f)
    v.face_density.push_back(averages_of(v, v.face_states[f], v.faces[f]).k / (2 * pi));
  v.centres.resize(n);
  middles(semidiscrete.blocks(), v.faces, v.centres);
  return v;
}

State state_in(const Cells& cells, std::size_t cell) {
  constexpr std::size_t reach = 2, stencil = 2 * reach + 1;
  const std::vector<double>& charge = cells.charge;
  if (charge[cell] == 0) return {};
  const double psi = std::atanh(cells.s[cell]);
  const bool inside = cell >= reach && cell + reach < cells.size() &&
                      std::find(&charge[cell - reach], &charge[cell + reach] + 1, 0.0) == &charge[cell + reach] + 1;
  if (!inside)
    return modulation::state_of({cells.width(cell) / charge[cell], cells.momentum(cell) / charge[cell]}, psi);
  const double *width = cells.values().widths() + cell - reach, *momentum = cells.values().momenta() + cell - reach;
  double width_at[stencil], momentum_at[stencil], charge_at[stencil];
  centre_values(stencil, {0, stencil}, width, width_at);
  centre_values(stencil, {0, stencil}, momentum, momentum_at);
  centre_values(stencil, {0, stencil}, &charge[cell - reach], charge_at);
  const double width_here = centre_width(width_at[reach], width[reach]);
  return modulation::state_of({width_here / charge_at[reach], momentum_at[reach] / charge_at[reach]}, psi);
}

State state_at(const View& v, double place) {
  double x = place;
  if (v.period > 0) x = std::clamp(place - turns(v, place) * v.period, v.faces.front(), v.faces.back());
  if (x < v.faces.front() || x > v.faces.back()) return {};
  const std::size_t cell = interval(v.faces, x);
  if (v.states[cell].empty()) return {};
  const Nodes nodes = nodes_around(v, cell, x);
  double phi[5] = {}, psi[5] = {};
  for (std::size_t j = 0; j < nodes.size; ++j) {
    phi[j] = nodes.state[j].phi;
    psi[j] = nodes.state[j].psi;
  }
  const auto [least, most] = std::minmax_element(psi, psi + nodes.size);
  const double phi_here = bounded(nodes.size, nodes.x, phi, x);
  const bool decades = *least > 0 && *most > 100 * *least;
  if (!decades) return {phi_here, std::fmax(bounded(nodes.size, nodes.x, psi, x), 0.0)};
  // If psi changes by decades from cell to cell, there are two cases. In a fan, phi changes by as much. In a slow
  // train, the logarithm of psi is smooth.
  const std::size_t j = interval(nodes.x, nodes.size, x);
  const double ratio = std::fabs(phi[j + 1] - phi[j]) / std::fabs(psi[j + 1] - psi[j]);
  if (ratio > 0.5 && ratio < 2) {
    const double share = std::clamp((x - nodes.x[j]) / (nodes.x[j + 1] - nodes.x[j]), 0.0, 1.0);
    return {phi_here, std::lerp(psi[j], psi[j + 1], share)};
  }
  for (std::size_t i = 0; i < nodes.size; ++i) psi[i] = std::log(psi[i]);
  return {phi_here, std::exp(bounded(nodes.size, nodes.x, psi, x))};
}

train::Averages averages_of(const View& v, const State& state, double x) {
  return v.contact ? train::averages(state, v.contact(x)) : train::averages(state);
}

double charge_left_of(const View& v, double place) {
  const double whole = v.period > 0 ? turns(v, place) : 0, x = place - whole * v.period;
  const double before = whole * (v.charge_faces.back() - v.charge_faces.front());
  // Some of the train outside may have entered between an end of the domain and the last face there.
  if (x <= v.faces.front())
    return before + v.charge_faces.front() - (v.left_free ? 0 : (v.faces.front() - x) * v.face_density.front());
  if (x >= v.faces.back())
    return before + v.charge_faces.back() + (v.right_free ? 0 : (x - v.faces.back()) * v.face_density.back());
  const std::size_t i = interval(v.faces, x);
  // Cubic Hermite interpolation with the known slopes k / 2 pi at the faces, limited to be monotone (Fritsch &
  // Carlson).
  const double h = v.faces[i + 1] - v.faces[i], rise = v.charge_faces[i + 1] - v.charge_faces[i], mean = rise / h;
  const auto slope = [&](std::size_t f) { return std::fmin(v.face_density[f], 3 * mean); };
  const double s = (x - v.faces[i]) / h, r = 1 - s;
  return before + v.charge_faces[i] + rise * s * s * (3 - 2 * s) + h * s * r * (slope(i) * r - slope(i + 1) * s);
}

}  // namespace slipfront::pulse
