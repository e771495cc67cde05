#include "averages/pulse/observe/observe.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <numeric>
#include <vector>

#include "math/constants.hpp"
#include "math/interpolation.hpp"
#include "slipfront/theory/modulation/modulation.hpp"
#include "slipfront/theory/train.hpp"

namespace slipfront::pulse {
namespace {

using output::Energy;
using std::numbers::pi;

/// Sums values per dislocation, given at the cell centres, over all dislocations. The sum is of fourth order in the
/// coordinate of the cells where the values are smooth, and of second order next to a jump or a free edge.
struct SumOverCells {
  const std::vector<double>& charge;
  double corrections = 0;  ///< total of the corrections in all sums
  double rough = 0;        ///< part of the last sum that comes from cells where the values are not smooth

  double operator()(const std::vector<double>& f) {
    double sum = 0;
    rough = 0;
    for (std::size_t i = 0; i < f.size(); ++i) {
      if (charge[i] == 0) continue;
      sum += charge[i] * f[i];
      if (!is_smooth(f, i)) {
        rough += charge[i] * f[i];
        continue;
      }
      corrections += correction(f, i);
      sum += correction(f, i);
    }
    return sum;
  }

 private:
  bool is_smooth(const std::vector<double>& f, std::size_t i) const {
    if (i == 0 || i + 1 == f.size() || charge[i - 1] == 0 || charge[i + 1] == 0) return false;
    const double before = f[i] - f[i - 1], behind = f[i + 1] - f[i];
    constexpr double smooth = 0.7;
    return std::fabs(behind - before) < smooth * (std::fabs(before) + std::fabs(behind));
  }
  double correction(const std::vector<double>& f, std::size_t i) const {
    return (f[i + 1] - 2 * f[i] + f[i - 1]) / 24 * charge[i] +
           (f[i + 1] - f[i - 1]) * (charge[i + 1] - charge[i - 1]) / 48;
  }
};

StoredEnergy stored_energy(const Solver& solver, const View& v) {
  const std::size_t n = v.states.size();
  std::vector<double> isolated(n), interaction(n), kinetic(n);
  for (std::size_t i = 0; i < n; ++i) {
    if (solver.charge()[i] == 0) continue;
    const double contact = v.contact ? v.contact(v.centres[i]) : 1;
    isolated[i] = 8 * contact;
    kinetic[i] = contact * modulation::kinetic_energy(v.states[i]);
    if (v.states[i].empty()) continue;  // dislocations too far apart to interact
    const double spacing = modulation::lagrangian_state(v.states[i]).spacing;
    interaction[i] = contact * modulation::interaction_energy(modulation::state_of({spacing, 0}, v.states[i].psi).psi);
  }
  SumOverCells sum{solver.charge()};
  StoredEnergy e{};
  e.isolated = sum(isolated);
  e.interaction = sum(interaction);
  e.kinetic = std::fmax(sum(kinetic), 0.0);
  e.correction = sum.corrections;
  e.unresolved = sum.rough;
  return e;
}

}  // namespace

Energy energy_of(const Solver& solver, const View& v) {
  const StoredEnergy stored = stored_energy(solver, v);
  return {.elastic = stored.elastic(),
          .kinetic = stored.kinetic,
          .dissipated = solver.dissipated(),
          .supplied = solver.supplied(),
          .through_ends = solver.through_ends(),
          .shocks = none,
          .residual = none,
          .phonons = none};
}

StoredEnergy stored_energy(const Solver& solver) { return stored_energy(solver, solver.view(false)); }

double conservation_error(const Solver& solver) {
  const View v = solver.view();
  double counted = 0, known = 0;
  for (std::size_t i = 0; i < v.states.size(); ++i) {
    known += solver.charge()[i];
    if (v.states[i].empty()) continue;
    const double middle = averages_of(v, v.states[i], v.centres[i]).k / (2 * pi);
    counted += (v.face_density[i] + 4 * middle + v.face_density[i + 1]) / 6 * (v.faces[i + 1] - v.faces[i]);
  }
  return std::fabs(counted - known) / known;
}

namespace {

using output::Observed;
using output::observed_fronts;
using output::Snapshot;
using std::numbers::pi;

std::vector<double> slip_velocities(const View& v) {
  std::vector<double> W(v.states.size());
  for (std::size_t i = 0; i < W.size(); ++i) W[i] = averages_of(v, v.states[i], v.centres[i]).W;
  return W;
}

/// Returns x if it is in the domain, and NaN if it is outside. On a ring, returns the equivalent position in the
/// domain.
double in_domain(const Problem& p, double x) {
  if (p.periodic) return x - std::floor((x - p.left) / (p.right - p.left)) * (p.right - p.left);
  const double rounding = 1e-12 * (p.right - p.left);
  return x >= p.left - rounding && x <= p.right + rounding ? std::clamp(x, p.left, p.right) : none;
}

/// Slip velocities at the faces and centres of the cells, from left to right. A pulse that is still narrower than a
/// cell appears only at its face.
struct Points {
  std::vector<double> x, W;
  std::vector<bool> shocked;

  void add(double place, double slip_velocity, bool near_shock) {
    x.push_back(place);
    W.push_back(slip_velocity);
    shocked.push_back(near_shock);
  }
};

/// Slip velocity in a cell, averaged over the ripple if there is one. Behind a shock that runs from cell to cell, W
/// oscillates by a few thousandths, with six to seven cells to a wave.
double without_ripple(const std::vector<double>& W, std::size_t i) {
  constexpr std::size_t half = 3;
  constexpr double small = 0.02;
  if (i < half || i + half >= W.size()) return W[i];
  const double* begin = &W[i - half];
  const double* end = &W[i + half] + 1;
  const auto [least, most] = std::minmax_element(begin, end);
  if (!(*most - *least < small * std::fabs(W[i]))) return W[i];
  return std::accumulate(begin, end, 0.0) / (2 * half + 1);
}

/// Collects the points in the domain: some cells are outside an end at which the train continues. `W` are the slip
/// velocities at the cell centres.
Points points_of(const Problem& problem, const View& v, const std::vector<double>& W) {
  Points points;
  const std::size_t n = W.size();
  const auto add = [&](double x, double slip_velocity, bool near_shock) {
    if (!std::isnan(in_domain(problem, x))) points.add(x, slip_velocity, near_shock);
  };
  const bool shocks = std::find(v.shocked.begin(), v.shocked.end(), 1.0) != v.shocked.end();
  const auto add_face = [&](std::size_t f) {
    if (shocks) return;
    add(v.faces[f], averages_of(v, v.face_states[f], v.faces[f]).W, false);
  };
  for (std::size_t i = 0; i < n; ++i) {
    add_face(i);
    add(v.centres[i], shocks ? without_ripple(W, i) : W[i], v.shocked[i] != 0);
  }
  add_face(n);
  return points;
}

/// Cells next to a shock exceed the values on both sides by a few per cent, and a pulse exceeds them by more.
constexpr double overshoot = 1.2;

void find_peak(const Points& p, Snapshot& s) {
  const auto size = [&](std::size_t i) { return std::fabs(p.W[i]); };
  const std::size_t n = p.W.size();
  s.peak_slip_velocity = 0;
  s.peak_position = none;
  if (n == 0) return;  // all dislocations have left the domain
  std::size_t peak = n, calm = n;
  for (std::size_t i = 0; i < n; ++i) {
    if (peak == n || size(i) > size(peak)) peak = i;
    if (!p.shocked[i] && (calm == n || size(i) > size(calm))) calm = i;
  }
  if (calm < n && size(peak) < overshoot * size(calm)) peak = calm;
  s.peak_slip_velocity = p.W[peak];
  s.peak_position = p.x[peak];
  // We take the top of the parabola through three points. Next to a shock there is none.
  const bool smooth = peak > 0 && peak + 1 < n && std::fmin(size(peak - 1), size(peak + 1)) > 0.9 * size(peak);
  if (!smooth) return;
  const double a = p.x[peak - 1] - p.x[peak], b = p.x[peak + 1] - p.x[peak];
  const auto [slope, curve] = parabola_through(a, p.W[peak - 1] - p.W[peak], b, p.W[peak + 1] - p.W[peak]);
  const double top = curve != 0 ? -slope / (2 * curve) : 0;
  if (!(top > a && top < b)) return;
  s.peak_slip_velocity += top * (slope + curve * top);
  s.peak_position += top;
}

/// Finds the observed fronts from the cells in the domain. `threshold` is relative to the peak slip velocity.
void find_observed_fronts(const Problem& problem, const View& v, std::vector<double> W, double threshold, bool to_right,
                          Snapshot& s) {
  for (std::size_t i = 0; i < W.size(); ++i) W[i] = std::isnan(in_domain(problem, v.centres[i])) ? 0 : std::fabs(W[i]);
  const double left = std::fmax(v.faces.front(), problem.left), right = std::fmin(v.faces.back(), problem.right);
  const Observed seen = observed_fronts(v.centres, W, threshold * std::fabs(s.peak_slip_velocity), left, right);
  s.fronts.trailing_observed = in_domain(problem, to_right ? seen.left : seen.right);
  s.fronts.leading_observed = in_domain(problem, to_right ? seen.right : seen.left);
}

/// Profile on the grid with the edges `x_edges`: k is the mean over a grid cell, all else is the value at its centre.
output::Profile profile_of(const Solver& solver, const View& v, const std::vector<double>& x_edges) {
  output::Profile profile;
  double left = charge_left_of(v, x_edges[0]);
  for (std::size_t i = 0; i + 1 < x_edges.size(); ++i) {
    const double right = charge_left_of(v, x_edges[i + 1]), x = (x_edges[i] + x_edges[i + 1]) / 2;
    const State state = state_at(v, x);
    const train::Averages a = averages_of(v, state, x);
    const double k = 2 * pi * (right - left) / (x_edges[i + 1] - x_edges[i]);
    profile.k.push_back(k);
    profile.U.push_back(state.empty() ? 0.0 : std::tanh(state.phi));
    // The size of W cannot exceed k. If k changes much within a grid cell, W at its centre can exceed the mean of k.
    profile.W.push_back(std::clamp(a.W, -k, k));
    profile.H.push_back(a.H);
    profile.slip.push_back(solver.slip_at(v, x));
    left = right;
  }
  return profile;
}

void find_values_at_origin(const Solver& solver, const View& v, Snapshot& s) {
  const train::Averages origin = averages_of(v, state_at(v, 0), 0);
  s.slip_velocity_at_origin = origin.W;
  s.stress_at_origin = origin.k;
  s.slip_at_origin = solver.slip_at(v, 0);
}

}  // namespace

Snapshot observe(const Solver& solver, const std::vector<double>& x_edges, const TrailingCharacteristic& trailing,
                 double threshold) {
  const View v = solver.view();
  Snapshot s{};
  s.time = solver.cells().time;
  s.profile = profile_of(solver, v, x_edges);
  find_values_at_origin(solver, v, s);
  const std::vector<double> W = slip_velocities(v);
  const bool to_right = trailing.stressed_left();
  const Problem& problem = solver.problem();
  const double characteristic = free_at(v, !to_right) ? none : in_domain(problem, trailing.position());
  s.fronts.trailing_characteristic = characteristic;
  // At t = 0 the front of a step of stress is at the step, and a smooth stress has no front yet.
  const bool smooth = !(problem.corner < HUGE_VAL);
  const double at_rest = smooth ? none : characteristic;
  s.fronts.trailing = s.time == 0 ? at_rest : in_domain(problem, trailing_front(v, W, to_right, smooth));
  s.fronts.leading = in_domain(problem, leading_front(v, W, to_right));
  find_peak(points_of(problem, v, W), s);
  const double beyond = v.shocked[interval(v.faces, 0)] != 0 ? overshoot : 1;
  if (std::fabs(s.slip_velocity_at_origin) > beyond * std::fabs(s.peak_slip_velocity)) {
    s.peak_slip_velocity = s.slip_velocity_at_origin;  // the peak is at x = 0, between the points of a coarse grid
    s.peak_position = 0;
  }
  s.peak_position = in_domain(problem, s.peak_position);
  find_observed_fronts(problem, v, W, threshold, to_right, s);
  s.energy = energy_of(solver, v);
  return s;
}

/// Part of the change of stress at which the front starts.
constexpr double noticed = 0.01;

TrailingCharacteristic::TrailingCharacteristic(const Solver& start) {
  const View v = start.view();
  const std::size_t n = v.states.size();
  constexpr double rounding = 1e-9;  // if both ends have equal stress, we take the left one on any grid
  // Free edges are tested first: there the stress falls to zero at the face, and not in the last cell.
  const auto is_left = [](double left, double right) { return left >= (1 - rounding) * right; };
  const Problem& p = start.problem();
  stressed_left_ = v.left_free != v.right_free ? v.right_free
                   : v.left_free               ? is_left(p.stress(p.left), p.stress(p.right))
                                               : is_left(v.states.front().psi, v.states.back().psi);
  const auto from_stressed = [&](std::size_t i) { return stressed_left_ ? i : n - 1 - i; };
  const auto stress = [&](double x) { return p.stress(x) / (v.contact ? v.contact(x) : 1); };
  const double end = v.faces[stressed_left_ ? 0 : n];
  const double stressed = stress(std::lerp(end, v.centres[from_stressed(0)], rounding));
  double low = stressed, high = stressed;
  constexpr int samples = 512;  // independent of the number of cells
  for (int i = 0; i < samples; ++i) {
    const double at = stress(std::lerp(v.faces.front(), v.faces.back(), (i + 0.5) / samples));
    low = std::fmin(low, at);
    high = std::fmax(high, at);
  }
  const bool uniform = high - low <= 1e-12 * high;  // uniform up to a free edge, where the front starts
  const auto departs = [&](double x, double share) {
    return !uniform && std::fabs(stress(x) - stressed) > share * (high - low);
  };
  const auto first = [&](double share) {
    std::size_t i = 0;
    while (i < n && !departs(v.centres[from_stressed(i)], share)) ++i;
    return i;
  };
  const std::size_t i = first(noticed);
  position_ = i < n ? v.centres[from_stressed(i)] : v.faces[stressed_left_ ? n : 0];
  double still = i == n ? position_ : i == 0 ? end : v.centres[from_stressed(i - 1)];
  while (true) {
    const double middle = still + (position_ - still) / 2;
    if (middle == still || middle == position_) break;
    (departs(middle, noticed) ? position_ : still) = middle;
  }
  steady_ = first(1e-12) == i && !p.forcing;
  speed_ = steady_ ? speed_into(v.states[from_stressed(0)]) : speed_at(start);
}

double TrailingCharacteristic::speed_into(const State& ahead) const {
  const auto speeds = modulation::characteristic_speeds(ahead);
  return stressed_left_ ? speeds.minus : speeds.plus;
}

/// Speed at the present position. For a smooth stress we interpolate between cells. For a corner we take a cell that is
/// farther ahead than a reconstruction reaches, so that the front itself has no effect.
double TrailingCharacteristic::speed_at(const Solver& now) const {
  const Cells& cells = now.cells();
  const std::size_t last = now.size() - 1;
  std::size_t cell = 0;
  double left = cells.left_edge();
  for (; cell < last && left + cells.width(cell) <= position_; ++cell) left += cells.width(cell);
  if (now.problem().corner < HUGE_VAL) {
    constexpr std::size_t reach = 6;
    return speed_into(now.state_in(stressed_left_ ? cell - std::min(cell, reach) : std::min(cell + reach, last)));
  }
  const double middle = left + cells.width(cell) / 2, here = speed_into(now.state_in(cell));
  const bool to_right = position_ > middle;
  if (to_right ? cell == last : cell == 0) return here;
  const std::size_t next = to_right ? cell + 1 : cell - 1;
  if (cells.charge[cell] == 0 || cells.charge[next] == 0) return here;
  const double apart = (cells.width(cell) + cells.width(next)) / 2;
  return std::lerp(here, speed_into(now.state_in(next)), std::fmin(std::fabs(position_ - middle) / apart, 1.0));
}

void TrailingCharacteristic::advance(const Solver& now, double dt) {
  if (steady_) {
    position_ += dt * speed_;
    return;
  }
  const double before = speed_;
  position_ += dt * before;
  position_ += dt * (speed_at(now) - before) / 2;
  speed_ = speed_at(now);
}

void TrailingCharacteristic::restore(const Solver& now, double position) {
  position_ = position;
  if (!steady_) speed_ = speed_at(now);
}

bool free_at(const View& v, bool right) { return right ? v.right_free : v.left_free; }

namespace {

/// Position of a shock at which W falls in cell `in`, seen from the front. We add up the widths of this cell and up to
/// six cells outwards, each times its slip velocity in units of that behind the shock. The sum is the distance of the
/// shock from the inner face of `in`.
double shock_near(const View& v, const std::vector<double>& W, std::size_t in, bool to_right) {
  constexpr std::size_t behind = 3, beyond = 6;
  const std::size_t n = W.size();
  const auto outward = [&](std::size_t steps) {
    return to_right ? std::min(in + steps, n - 1) : in - std::min(in, steps);
  };
  const std::size_t back = to_right ? in - std::min(in, behind) : std::min(in + behind, n - 1);
  double way = 0;
  std::size_t last = n;
  for (std::size_t j = 0; j <= beyond; ++j) {
    const std::size_t i = outward(j);
    if (i == last) break;
    last = i;
    way += (v.faces[i + 1] - v.faces[i]) * std::clamp(W[i] / W[back], 0.0, 1.0);
  }
  return to_right ? v.faces[in] + way : v.faces[in + 1] - way;
}

}  // namespace

double leading_front(const View& v, const std::vector<double>& W, bool to_right) {
  const std::size_t n = W.size();
  if (free_at(v, to_right)) return to_right ? v.faces.back() : v.faces.front();
  double half = 0;
  for (const double w : W) half = std::fmax(half, std::fabs(w) / 2);
  for (std::size_t i = 1; i < n && half > 0; ++i) {  // from the front inwards
    const std::size_t out = to_right ? n - i : i - 1, in = to_right ? out - 1 : out + 1;
    const double a = std::fabs(W[in]), b = std::fabs(W[out]);
    if (!(a >= half && b < half)) continue;
    if (v.shocked[in] != 0) return shock_near(v, W, in, to_right);
    return std::lerp(v.centres[in], v.centres[out], (half - a) / (b - a));
  }
  return none;
}

namespace {

/// Slip velocities from the more stressed end inwards, as differences from the value at that end.
struct Inwards {
  const View& v;
  const std::vector<double>& W;
  bool stressed_left;

  std::size_t index(std::size_t i) const { return stressed_left ? i : W.size() - 1 - i; }
  double x(std::size_t i) const { return v.centres[index(i)]; }
  double change(std::size_t i) const { return W[index(i)] - W[index(0)]; }
  /// Position between the centres of the cells i - 1 and i at which the size of the change equals `level`.
  double place(std::size_t i, double level) const {
    const double before = std::fabs(change(i - 1)), after = std::fabs(change(i));
    return std::lerp(x(i - 1), x(i), (level - before) / (after - before));
  }
  /// Like `place`, but for a tail that falls by a factor from cell to cell: the logarithm is nearly linear in x.
  double place_in_tail(std::size_t i, double level) const {
    const double before = std::fabs(change(i - 1)), after = std::fabs(change(i));
    if (!(before > 0) || before * after < 0) return place(i, level);
    return std::lerp(x(i - 1), x(i), std::log(level / before) / std::log(after / before));
  }
};

/// Foot of a fan that rises to `top` within a few cells of `first`. We draw a straight line through its points at a
/// quarter and at three quarters of `top`, which the smeared corners of the fan affect least.
double foot_of_narrow_fan(const Inwards& in, std::size_t first, double top) {
  std::size_t i = first;
  const auto place_of = [&](double level) {
    while (std::fabs(in.change(i)) < level) ++i;
    return in.place(i, level);
  };
  const double quarter = place_of(0.25 * top), three_quarters = place_of(0.75 * top);
  return quarter - (three_quarters - quarter) / 2;
}

}  // namespace

double trailing_front(const View& v, const std::vector<double>& W, bool stressed_left, bool smooth) {
  constexpr double felt = 1e-3;
  constexpr std::size_t behind = 4, apart = 3, last = behind + 2 * apart;  // a fan's corner is smeared over 2 cells
  const std::size_t n = W.size();
  if (free_at(v, !stressed_left)) return none;
  const Inwards in{v, W, stressed_left};
  double most = 0;
  for (const double w : W) most = std::fmax(most, std::fabs(w));
  std::size_t first = 0;
  while (first < n && !(std::fabs(in.change(first)) > felt * most)) ++first;
  if (first <= 1 || first + last + behind >= n) return none;  // the front has reached the end, or nothing moves
  if (smooth) return in.place_in_tail(first, felt * most);
  double top = 0;
  for (std::size_t i = first; i <= first + last + behind; ++i) top = std::fmax(top, std::fabs(in.change(i)));
  double x[3], w[3];
  for (std::size_t j = 0; j < 3; ++j) {
    x[j] = in.x(first + behind + apart * j);
    w[j] = in.change(first + behind + apart * j);
  }
  const bool narrow = std::fabs(w[2]) > 0.85 * top && top > 10 * felt * most;
  if (narrow) return foot_of_narrow_fan(in, first, top);
  const bool rises = std::fabs(w[0]) > 0 && w[1] / w[0] > 1.2 && w[2] / w[1] > 1.1;
  const bool tail = w[0] * w[2] > 0.95 * w[1] * w[1];  // an exponential tail, as from a smooth stress, has no foot
  if (!rises || tail) return in.place_in_tail(first, felt * most);
  const auto [slope, curve] = parabola_through(w[1] - w[0], x[1] - x[0], w[2] - w[0], x[2] - x[0]);
  const double foot = x[0] - w[0] * (slope - curve * w[0]);
  const double ahead = in.x(first - 1), farthest = ahead - 2 * (in.x(first) - ahead);
  return std::clamp(foot, std::fmin(farthest, x[0]), std::fmax(farthest, x[0]));
}

}  // namespace slipfront::pulse
