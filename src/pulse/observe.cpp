#include "slipfront/pulse/observe.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "../parabola.hpp"
#include "slipfront/modulation/characteristics.hpp"
#include "slipfront/modulation/per_dislocation.hpp"
#include "slipfront/train/train.hpp"

namespace slipfront::pulse {
namespace {

using std::numbers::pi;
constexpr double none = std::numeric_limits<double>::quiet_NaN();

/// The edge of what moves on the less stressed side: the free edge, or where the velocity behind it falls through half
/// of its largest.
double leading_front(const Solver::View& v, bool to_right) {
  const std::size_t n = v.states.size();
  if ((to_right ? v.face_states.back() : v.face_states.front()).empty())
    return to_right ? v.faces.back() : v.faces.front();
  double fastest = 0;
  for (const State& s : v.states) fastest = std::fmax(fastest, std::fabs(s.phi));
  for (std::size_t i = 1; i < n && fastest > 0; ++i) {  // from the front inwards
    const std::size_t out = to_right ? n - i : i - 1, in = to_right ? out - 1 : out + 1;
    const double a = std::fabs(v.states[in].phi), b = std::fabs(v.states[out].phi);
    if (a >= fastest / 2 && b < fastest / 2)
      return std::lerp(v.centres[in], v.centres[out], (fastest / 2 - a) / (b - a));
  }
  return none;
}

void find_peak_and_observed_fronts(const Solver::View& v, double threshold, bool to_right, Snapshot& s) {
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
    const auto [slope, curve] = parabola_through(a, W[peak - 1] - W[peak], b, W[peak + 1] - W[peak]);
    const double top = curve != 0 ? -slope / (2 * curve) : 0;
    if (top > a && top < b) {
      s.peak_slip_velocity += top * (slope + curve * top);
      s.peak_position += top;
    }
  }
  for (double& w : W) w = std::fabs(w);
  const Observed seen =
      observed_fronts(v.centres, W, threshold * std::fabs(s.peak_slip_velocity), v.faces.front(), v.faces.back());
  s.fronts.trailing_observed = to_right ? seen.left : seen.right;
  s.fronts.leading_observed = to_right ? seen.right : seen.left;
}

Energy energy_of(const Solver& solver, const Solver::View& v) {
  Energy e{0, 0, solver.dissipated(), solver.supplied(), none};
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

TrailingFront::TrailingFront(const Solver& start) {
  const Solver::View v = start.view();
  const std::size_t n = v.states.size();
  // Cells stop at a free edge: there it is the face that is empty.
  stressed_left_ =
      v.face_states.back().empty() || (!v.face_states.front().empty() && v.states.front().psi >= v.states.back().psi);
  const auto from_stressed = [&](std::size_t i) { return stressed_left_ ? i : n - 1 - i; };
  const State stressed = v.states[from_stressed(0)];
  double low = stressed.psi, high = low;
  for (const State& s : v.states) {
    low = std::fmin(low, s.psi);
    high = std::fmax(high, s.psi);
  }
  const bool uniform = high - low <= 1e-12 * high;  // up to a free edge: the front starts there
  const auto departs = [&](double share) {
    std::size_t i = 0;
    while (i < n && (uniform || std::fabs(v.states[from_stressed(i)].psi - stressed.psi) <= share * (high - low))) ++i;
    return i;
  };
  const std::size_t i = departs(0.01);
  position_ = v.faces[stressed_left_ ? i : n - i];
  steady_ = departs(1e-12) == i && !start.problem().forcing;
  speed_ = speed_into(stressed);
}

double TrailingFront::speed_into(const State& ahead) const {
  const auto speeds = modulation::characteristic_speeds(ahead);
  return stressed_left_ ? speeds.minus : speeds.plus;
}

void TrailingFront::advance(const Solver& now, double dt) {
  if (steady_) {
    position_ += dt * speed_;
    return;
  }
  const std::vector<double>& y = now.cells().y;
  std::size_t cell = 0;
  for (double right = y[2 * now.size()] + y[0]; cell + 1 < now.size() && right <= position_; right += y[2 * cell])
    ++cell;
  // Ahead of it by more than a reconstruction reaches, so that the front itself is not seen.
  const std::size_t ahead = stressed_left_ ? (cell > 6 ? cell - 6 : 0) : std::min(cell + 6, now.size() - 1);
  position_ += dt * speed_into(now.state_in(ahead));
}

Snapshot observe(const Solver& solver, const std::vector<double>& x_edges, const TrailingFront& trailing,
                 double threshold) {
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
    const train::Averages a = averages_of(v, state, x);
    s.profile.W.push_back(a.W);
    s.profile.H.push_back(a.H);
    s.profile.slip.push_back(solver.slip_at(v, x));
    left = right;
  }
  const train::Averages origin = averages_of(v, state_at(v, 0), 0);
  s.slip_velocity_at_origin = origin.W;
  s.stress_at_origin = origin.k;
  s.slip_at_origin = solver.slip_at(v, 0);
  s.fronts.trailing = trailing.position();
  s.fronts.leading = leading_front(v, trailing.stressed_left());
  find_peak_and_observed_fronts(v, threshold, trailing.stressed_left(), s);
  s.energy = energy_of(solver, v);
  return s;
}

double conservation_error(const Solver& solver, const std::vector<double>& x_edges, const Profile& profile) {
  const Solver::View v = solver.view();
  double sum = charge_left_of(v, x_edges.front());
  for (std::size_t i = 0; i + 1 < x_edges.size(); ++i) sum += profile.k[i] * (x_edges[i + 1] - x_edges[i]) / (2 * pi);
  double initial = -solver.cells().entered_left;
  for (const double q : solver.charge()) initial += q;
  sum += v.charge_faces.back() - charge_left_of(v, x_edges.back());
  return std::fabs(sum - initial) / (initial + solver.cells().entered_left);
}

}  // namespace slipfront::pulse
