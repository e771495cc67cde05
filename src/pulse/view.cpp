#include <algorithm>
#include <cmath>

#include "interval.hpp"
#include "lagrange.hpp"
#include "slipfront/pulse/solver.hpp"
#include "slipfront/train/train.hpp"

namespace slipfront::pulse {
namespace {

/// How often a ring must be turned back to bring x among its faces.
double turns(const Solver::View& v, double x) { return std::floor((x - v.faces.front()) / v.period); }

/// Centres and faces around a place, at most five that rise with x.
struct Nodes {
  double x[5];
  State state[5];
  std::size_t size = 0;

  void add(double place, const State& s) {
    x[size] = place;
    state[size++] = s;
  }
};

/// The centre of the cell, its faces, and the centres of its neighbours in the same stretch. A step of stress, or a
/// pulse that is still narrower than a cell, is known at a face long before the cells feel it.
Nodes nodes_around(const Solver::View& v, std::size_t cell) {
  Nodes nodes;
  if (cell > 0 && !v.states[cell - 1].empty()) nodes.add(v.centres[cell - 1], v.states[cell - 1]);
  nodes.add(v.faces[cell], v.face_states[cell]);
  nodes.add(v.centres[cell], v.states[cell]);
  nodes.add(v.faces[cell + 1], v.face_states[cell + 1]);
  if (cell + 1 < v.states.size() && !v.states[cell + 1].empty()) nodes.add(v.centres[cell + 1], v.states[cell + 1]);
  return nodes;
}

/// Whether three values and the next one bend alike.
bool bends_alike(const double* x, const double* f) {
  const auto slope = [&](std::size_t j) { return (f[j + 1] - f[j]) / (x[j + 1] - x[j]); };
  const double bend = (slope(1) - slope(0)) / (x[2] - x[0]), next = (slope(2) - slope(1)) / (x[3] - x[1]);
  return std::fabs(next - bend) < 0.5 * (std::fabs(bend) + std::fabs(next));
}

/// The polynomial through all of `size` points. Where these are not smooth, there is no value beyond the two beside x;
/// a smooth extremum lies beyond all of them by a part of their range.
double bounded(std::size_t size, const double* at, const double* f, double x) {
  const std::size_t next = std::clamp<std::size_t>(
      static_cast<std::size_t>(std::upper_bound(at, at + size, x) - at), 1, size - 1);
  bool smooth = true;
  for (std::size_t j = 0; j + 3 < size; ++j) smooth = smooth && bends_alike(at + j, f + j);
  const double sum = lagrange(size, at, f, x);
  if (!smooth) return std::clamp(sum, std::min(f[next - 1], f[next]), std::max(f[next - 1], f[next]));
  const auto [least, most] = std::minmax_element(f, f + size);
  const double beyond = (*most - *least) / 4;
  return std::clamp(sum, *least - beyond, *most + beyond);
}

}  // namespace

State state_at(const Solver::View& v, double place) {
  double x = place;
  if (v.period > 0) x = std::clamp(place - turns(v, place) * v.period, v.faces.front(), v.faces.back());
  if (x < v.faces.front() || x > v.faces.back()) return {};
  const std::size_t cell = interval(v.faces, x);
  if (v.states[cell].empty()) return {};
  const Nodes nodes = nodes_around(v, cell);
  double phi[5], psi[5], log_psi[5];
  for (std::size_t j = 0; j < nodes.size; ++j) {
    phi[j] = nodes.state[j].phi;
    psi[j] = nodes.state[j].psi;
    log_psi[j] = std::log(psi[j]);
  }
  const auto [least, most] = std::minmax_element(psi, psi + nodes.size);
  // In a slow train psi changes by decades from cell to cell, its logarithm is what is smooth.
  const bool decades = *least > 0 && *most > 100 * *least;
  return {bounded(nodes.size, nodes.x, phi, x), decades ? std::exp(bounded(nodes.size, nodes.x, log_psi, x))
                                                        : std::fmax(bounded(nodes.size, nodes.x, psi, x), 0.0)};
}

train::Averages averages_of(const Solver::View& v, const State& state, double x) {
  return v.contact ? train::averages(state, v.contact(x)) : train::averages(state);
}

double charge_left_of(const Solver::View& v, double place) {
  const double whole = v.period > 0 ? turns(v, place) : 0, x = place - whole * v.period;
  const double before = whole * (v.charge_faces.back() - v.charge_faces.front());
  // Between an end of the domain and the last face there, the train that goes on beyond may have come in a little.
  if (x <= v.faces.front())
    return before + v.charge_faces.front() - (v.left_free ? 0 : (v.faces.front() - x) * v.face_density.front());
  if (x >= v.faces.back())
    return before + v.charge_faces.back() + (v.right_free ? 0 : (x - v.faces.back()) * v.face_density.back());
  const std::size_t i = interval(v.faces, x);
  // Cubic Hermite: the slopes k / 2 pi at the faces are known; limited so that it cannot fall (Fritsch & Carlson).
  const double h = v.faces[i + 1] - v.faces[i], rise = v.charge_faces[i + 1] - v.charge_faces[i], mean = rise / h;
  const auto slope = [&](std::size_t f) { return std::fmin(v.face_density[f], 3 * mean); };
  const double s = (x - v.faces[i]) / h, r = 1 - s;
  return before + v.charge_faces[i] + rise * s * s * (3 - 2 * s) + h * s * r * (slope(i) * r - slope(i + 1) * s);
}

}  // namespace slipfront::pulse
