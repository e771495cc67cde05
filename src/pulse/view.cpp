#include <algorithm>
#include <cmath>

#include "interval.hpp"
#include "slipfront/pulse/solver.hpp"
#include "slipfront/train/train.hpp"

namespace slipfront::pulse {
namespace {

/// How often a ring must be turned back to bring x among its faces.
double turns(const Solver::View& v, double x) { return std::floor((x - v.faces.front()) / v.period); }

}  // namespace

State state_at(const Solver::View& v, double place) {
  double x = place;
  if (v.period > 0) x = std::clamp(place - turns(v, place) * v.period, v.faces.front(), v.faces.back());
  if (x < v.faces.front() || x > v.faces.back()) return {};
  const std::size_t cell = interval(v.faces, x);
  if (v.states[cell].empty()) return {};
  std::size_t begin = cell, end = cell + 1;  // four centres of the same stretch
  while (begin > 0 && cell - begin < 4 && !v.states[begin - 1].empty()) --begin;
  while (end < v.states.size() && end - cell < 5 && !v.states[end].empty()) ++end;
  if (end - begin < 4) return v.states[cell];
  const std::size_t left = v.centres[cell] <= x || cell == 0 ? cell : cell - 1;
  const std::size_t first = std::clamp<std::size_t>(left, begin + 1, end - 3) - 1;
  double weight[4];
  for (std::size_t j = 0; j < 4; ++j) {  // Lagrange through four centres
    weight[j] = 1;
    for (std::size_t m = 0; m < 4; ++m)
      if (m != j) weight[j] *= (x - v.centres[first + m]) / (v.centres[first + j] - v.centres[first + m]);
  }
  const auto interpolate = [&](double State::*member) {
    const auto f = [&](std::size_t j) { return v.states[first + j].*member; };
    const double sum = weight[0] * f(0) + weight[1] * f(1) + weight[2] * f(2) + weight[3] * f(3);
    const double bend = f(0) - 2 * f(1) + f(2), next_bend = f(1) - 2 * f(2) + f(3);
    const double least = std::min({f(0), f(1), f(2), f(3)}), most = std::max({f(0), f(1), f(2), f(3)});
    // A smooth extremum lies beyond the four by an eighth of their range; where they are not smooth on the grid, or
    // cells differ much in width, there is no value beyond them.
    const bool smooth = std::fabs(next_bend - bend) < 0.5 * (std::fabs(bend) + std::fabs(next_bend));
    const double beyond = smooth ? (most - least) / 4 : 0;
    return std::clamp(sum, least - beyond, most + beyond);
  };
  // In a slow train psi changes by decades from cell to cell, its logarithm is what is smooth.
  double log_psi[4], least = HUGE_VAL, most = 0;
  for (std::size_t j = 0; j < 4; ++j) {
    const double psi = v.states[first + j].psi;
    log_psi[j] = std::log(psi);
    least = std::fmin(least, psi);
    most = std::fmax(most, psi);
  }
  if (!(most > 100 * least)) return {interpolate(&State::phi), std::fmax(interpolate(&State::psi), 0.0)};
  const double sum = weight[0] * log_psi[0] + weight[1] * log_psi[1] + weight[2] * log_psi[2] + weight[3] * log_psi[3];
  return {interpolate(&State::phi), std::exp(std::clamp(sum, std::log(least), std::log(most)))};
}

train::Averages averages_of(const Solver::View& v, const State& state, double x) {
  return v.contact ? train::averages(state, v.contact(x)) : train::averages(state);
}

double charge_left_of(const Solver::View& v, double place) {
  const double whole = v.period > 0 ? turns(v, place) : 0, x = place - whole * v.period;
  const double before = whole * (v.charge_faces.back() - v.charge_faces.front());
  if (x <= v.faces.front()) return before + v.charge_faces.front();
  if (x >= v.faces.back()) return before + v.charge_faces.back();
  const std::size_t i = interval(v.faces, x);
  // Cubic Hermite: the slopes k / 2 pi at the faces are known; limited so that it cannot fall (Fritsch & Carlson).
  const double h = v.faces[i + 1] - v.faces[i], rise = v.charge_faces[i + 1] - v.charge_faces[i], mean = rise / h;
  const auto slope = [&](std::size_t f) { return std::fmin(v.face_density[f], 3 * mean); };
  const double s = (x - v.faces[i]) / h, r = 1 - s;
  return before + v.charge_faces[i] + rise * s * s * (3 - 2 * s) + h * s * r * (slope(i) * r - slope(i + 1) * s);
}

}  // namespace slipfront::pulse
