#include "slipfront/pulse/observe.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "slipfront/modulation/characteristics.hpp"
#include "slipfront/modulation/per_dislocation.hpp"
#include "slipfront/train/train.hpp"

namespace slipfront::pulse {
namespace {

using std::numbers::pi;
constexpr double none = std::numeric_limits<double>::quiet_NaN();

/// The right edge of what moves: the free edge, or where the velocity behind it falls through half of its largest.
double right_front(const Solver::View& v) {
  if (v.face_states.back().empty()) return v.faces.back();
  double fastest = 0;
  for (const State& s : v.states) fastest = std::fmax(fastest, std::fabs(s.phi));
  for (std::size_t i = v.states.size() - 1; i-- > 0 && fastest > 0;) {
    const double a = std::fabs(v.states[i].phi), b = std::fabs(v.states[i + 1].phi);
    if (a >= fastest / 2 && b < fastest / 2)
      return std::lerp(v.centres[i], v.centres[i + 1], (fastest / 2 - a) / (b - a));
  }
  return none;
}

void find_peak_and_observed_fronts(const Solver::View& v, double threshold, Snapshot& s) {
  const std::size_t n = v.states.size();
  std::vector<double> W(n);
  for (std::size_t i = 0; i < n; ++i) W[i] = averages_of(v, v.states[i], v.centres[i]).W;
  const auto size = [&](std::size_t i) { return std::fabs(W[i]); };
  std::size_t peak = 0;
  for (std::size_t i = 1; i < n; ++i)
    if (size(i) > size(peak)) peak = i;
  s.peak_slip_velocity = W[peak];
  s.peak_position = v.centres[peak];
  // Top of the parabola through three centres; beside a shock there is none.
  const bool smooth = peak > 0 && peak + 1 < n && std::fmin(size(peak - 1), size(peak + 1)) > 0.9 * size(peak);
  if (smooth) {
    const double a = v.centres[peak - 1] - v.centres[peak], b = v.centres[peak + 1] - v.centres[peak];
    const double fa = (W[peak - 1] - W[peak]) / a, fb = (W[peak + 1] - W[peak]) / b;
    const double curve = (fb - fa) / (b - a), slope = fa - curve * a;
    const double top = curve != 0 ? -slope / (2 * curve) : 0;
    if (top > a && top < b) {
      s.peak_slip_velocity += top * (slope + curve * top);
      s.peak_position += top;
    }
  }
  for (double& w : W) w = std::fabs(w);
  const Observed seen =
      observed_fronts(v.centres, W, threshold * std::fabs(s.peak_slip_velocity), v.faces.front(), v.faces.back());
  s.fronts.trailing_observed = seen.trailing;
  s.fronts.leading_observed = seen.leading;
}

Energy energy_of(const Solver& solver, const Solver::View& v) {
  Energy e{0, 0, solver.dissipated(), solver.supplied()};
  const std::size_t n = v.states.size();
  std::vector<double> width(n), rest(n), moving(n);
  for (std::size_t i = 0; i < n; ++i) {
    width[i] = v.faces[i + 1] - v.faces[i];
    if (v.states[i].empty()) continue;
    const double x = v.centres[i], contact = v.contact ? v.contact(x) : 1;
    const train::Averages a = averages_of(v, v.states[i], x);
    const State at_rest = modulation::state_of({2 * pi * contact / a.k, 0}, v.states[i].psi);
    rest[i] = averages_of(v, at_rest, x).H;
    moving[i] = a.H - rest[i];
  }
  // A cell's integral from the values at centres, fourth order in the cells' own coordinate.
  const auto integral = [&](const std::vector<double>& f, std::size_t i) {
    if (i == 0 || i + 1 == n || v.states[i - 1].empty() || v.states[i + 1].empty()) return f[i] * width[i];
    return (f[i] + (f[i - 1] - 2 * f[i] + f[i + 1]) / 24) * width[i] +
           (f[i + 1] - f[i - 1]) * (width[i + 1] - width[i - 1]) / 48;
  };
  for (std::size_t i = 0; i < n; ++i) {
    e.elastic += integral(rest, i);
    e.kinetic += integral(moving, i);
  }
  return e;
}

}  // namespace

LeftFront::LeftFront(const Solver& start) {
  const Solver::View v = start.view();
  double low = v.states.front().psi, high = low;
  for (const State& s : v.states) {
    low = std::fmin(low, s.psi);
    high = std::fmax(high, s.psi);
  }
  const auto departs = [&](std::size_t i, double share) {
    return std::fabs(v.states[i].psi - v.states.front().psi) > share * (high - low);
  };
  const std::size_t n = v.states.size();
  const bool uniform = high - low <= 1e-12 * high;  // up to a free edge: the front starts there
  std::size_t i = 0;
  while (i < n && (uniform || !departs(i, 0.01))) ++i;
  position_ = v.faces[i];
  std::size_t moved = 0;
  while (moved < n && (uniform || !departs(moved, 1e-12))) ++moved;
  steady_ = moved == i && !start.problem().forcing;
  speed_ = modulation::characteristic_speeds(v.states.front()).minus;
}

void LeftFront::advance(const Solver& now, double dt) {
  if (steady_) {
    position_ += dt * speed_;
    return;
  }
  const std::vector<double>& y = now.cells().y;
  std::size_t cell = 0;
  for (double right = y[2 * now.size()] + y[0]; cell + 1 < now.size() && right <= position_; right += y[2 * cell])
    ++cell;
  // Ahead of it by more than a reconstruction reaches, so that the front itself is not seen.
  const State ahead = now.state_in(cell > 6 ? cell - 6 : 0);
  position_ += dt * modulation::characteristic_speeds(ahead).minus;
}

Snapshot observe(const Solver& solver, const std::vector<double>& x_edges, double left_front, double threshold) {
  const Solver::View v = solver.view();
  Snapshot s{};
  s.time = solver.cells().time;
  const std::size_t n = x_edges.size() - 1;
  double left = charge_left_of(v, x_edges[0]);
  for (std::size_t i = 0; i < n; ++i) {
    const double right = charge_left_of(v, x_edges[i + 1]), x = (x_edges[i] + x_edges[i + 1]) / 2;
    const State state = state_at(v, x);
    s.profile.k.push_back(2 * pi * (right - left) / (x_edges[i + 1] - x_edges[i]));
    s.profile.U.push_back(state.empty() ? 0.0 : std::tanh(state.phi));
    s.profile.W.push_back(averages_of(v, state, x).W);
    s.profile.slip.push_back(2 * pi * (solver.initial_charge_left_of(x) - charge_left_of(v, x)));
    left = right;
  }
  const train::Averages origin = averages_of(v, state_at(v, 0), 0);
  s.slip_velocity_at_origin = origin.W;
  s.stress_at_origin = origin.k;
  s.slip_at_origin = 2 * pi * (solver.initial_charge_left_of(0) - charge_left_of(v, 0));
  s.fronts.trailing = left_front;
  s.fronts.leading = right_front(v);
  find_peak_and_observed_fronts(v, threshold, s);
  s.energy = energy_of(solver, v);
  return s;
}

double conservation_error(const Solver& solver, const std::vector<double>& x_edges, const Profile& profile) {
  const Solver::View v = solver.view();
  double sum = charge_left_of(v, x_edges.front());
  for (std::size_t i = 0; i + 1 < x_edges.size(); ++i) sum += profile.k[i] * (x_edges[i + 1] - x_edges[i]) / (2 * pi);
  double initial = 0;
  for (const double q : solver.charge()) initial += q;
  sum += v.charge_faces.back() - charge_left_of(v, x_edges.back());
  return std::fabs(sum - initial) / initial;
}

}  // namespace slipfront::pulse
