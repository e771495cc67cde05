#include "events/finite_fault/along_fault.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>
#include <utility>

#include "events/finite_fault/on_plane.hpp"
#include "math/digits.hpp"
#include "slipfront/error.hpp"
#include "slipfront/theory/medium/constants.hpp"
#include "slipfront/theory/medium/medium.hpp"
#include "slipfront/theory/rupture/relations.hpp"

namespace slipfront::finite_fault {

using catalogue::Observation;
using catalogue::Subfault;
using medium::Elastic;
using medium::elastic;

namespace {

/// Direction of the largest spread of points (a, b): (cos, sin).
struct Direction {
  double cos, sin;
};
template <class A, class B>
Direction longest(const std::vector<LocalState>& states, std::size_t from, std::size_t to, const A& a, const B& b) {
  const double n = static_cast<double>(to - from);
  double ma = 0, mb = 0, aa = 0, ab = 0, bb = 0;
  for (std::size_t i = from; i < to; ++i) ma += a(states[i]) / n, mb += b(states[i]) / n;
  for (std::size_t i = from; i < to; ++i) {
    const double da = a(states[i]) - ma, db = b(states[i]) - mb;
    aa += da * da, ab += da * db, bb += db * db;
  }
  const double angle = std::atan2(2 * ab, aa - bb) / 2;
  return {std::cos(angle), std::sin(angle)};
}

/// Coordinates in the plane of one segment: strike is the direction of its largest horizontal extent.
void lay_in_plane(std::vector<LocalState>& states, std::size_t from, std::size_t to) {
  const auto x = [](const LocalState& s) { return s.subfault.x; };
  const auto y = [](const LocalState& s) { return s.subfault.y; };
  const auto z = [](const LocalState& s) { return s.subfault.z; };
  // Over the row of the least depth only: over the whole of a flat fault the widest direction may be down dip.
  double top = HUGE_VAL, bottom = -HUGE_VAL;
  for (std::size_t i = from; i < to; ++i) top = std::fmin(top, z(states[i])), bottom = std::fmax(bottom, z(states[i]));
  std::vector<LocalState> row;
  for (std::size_t i = from; i < to; ++i)
    if (z(states[i]) <= top + 1e-3 * (bottom - top)) row.push_back(states[i]);
  const Direction strike = row.size() > 1 ? longest(row, 0, row.size(), x, y) : longest(states, from, to, x, y);
  const auto across = [&](const LocalState& s) { return -strike.sin * x(s) + strike.cos * y(s); };
  Direction dip = longest(states, from, to, across, z);
  if (dip.sin < 0) dip = {-dip.cos, -dip.sin};
  double along_middle = 0, down_middle = 0;
  for (std::size_t i = from; i < to; ++i) {
    states[i].along_strike = strike.cos * x(states[i]) + strike.sin * y(states[i]);
    states[i].down_dip = dip.cos * across(states[i]) + dip.sin * z(states[i]);
    along_middle += states[i].along_strike / static_cast<double>(to - from);
    down_middle += states[i].down_dip / static_cast<double>(to - from);
  }
  for (std::size_t i = from; i < to; ++i) {
    states[i].along_strike -= along_middle;
    states[i].down_dip -= down_middle;
  }
}

/// The subfaults of one segment that have a rupture time, in their order along strike.
std::vector<std::size_t> timed_along_strike(const std::vector<LocalState>& states, std::size_t from, std::size_t to) {
  std::vector<std::size_t> order;
  for (std::size_t i = from; i < to; ++i)
    if (states[i].subfault.rupture_time) order.push_back(i);
  std::sort(order.begin(), order.end(),
            [&](std::size_t a, std::size_t b) { return states[a].along_strike < states[b].along_strike; });
  return order;
}

/// The eight subfaults that are nearest to order[at], or all if there are fewer. In each direction the search ends
/// where the distance along strike exceeds that of the eighth, because models have up to 10^5 subfaults.
std::vector<std::pair<double, std::size_t>> nearest_of(const std::vector<LocalState>& states,
                                                       const std::vector<std::size_t>& order, std::size_t at) {
  const LocalState& here = states[order[at]];
  std::vector<std::pair<double, std::size_t>> near;  // squared distance, and index
  const auto offer = [&](std::size_t index) {
    const double along = std::pow(states[index].along_strike - here.along_strike, 2);
    if (near.size() == 8 && along > near.back().first) return false;
    const std::pair<double, std::size_t> one{along + std::pow(states[index].down_dip - here.down_dip, 2), index};
    near.insert(std::upper_bound(near.begin(), near.end(), one), one);
    if (near.size() > 8) near.pop_back();
    return true;
  };
  for (std::size_t j = at; j > 0 && offer(order[j - 1]);) --j;
  for (std::size_t j = at + 1; j < order.size() && offer(order[j]);) ++j;
  return near;
}

/// Speed of the rupture at order[number], by a plane through its rupture time and those of its eight nearest
/// neighbours.
std::optional<double> speed_at(const std::vector<LocalState>& states, const std::vector<std::size_t>& order,
                               std::size_t number) {
  const LocalState& here = states[order[number]];
  const auto near = nearest_of(states, order, number);
  if (near.size() < 3) return std::nullopt;
  double aa = 0, ab = 0, bb = 0, at = 0, bt = 0;
  for (const auto& [distance, index] : near) {
    const LocalState& n = states[index];
    const double a = n.along_strike - here.along_strike, b = n.down_dip - here.down_dip;
    const double t = *n.subfault.rupture_time - *here.subfault.rupture_time;
    aa += a * a, ab += a * b, bb += b * b, at += a * t, bt += b * t;
  }
  const double determinant = aa * bb - ab * ab;
  if (!(determinant > 1e-6 * aa * bb)) return std::nullopt;
  const double slowness = std::hypot((at * bb - bt * ab) / determinant, (bt * aa - at * ab) / determinant);
  if (!(slowness > 0)) return std::nullopt;  // all at once: no front to speak of
  return 1 / slowness;
}

}  // namespace

std::vector<LocalState> along_fault(const Observation& o, const medium::Defaults& defaults) {
  const Elastic e = elastic(o, defaults);
  std::vector<LocalState> states;
  states.reserve(o.subfaults.size());
  for (const Subfault& s : o.subfaults) states.push_back({.subfault = s});
  for (std::size_t from = 0, to = 0; from < states.size(); from = to) {
    while (to < states.size() && states[to].subfault.segment == states[from].subfault.segment) ++to;
    lay_in_plane(states, from, to);
    const std::vector<std::size_t> order = timed_along_strike(states, from, to);
    for (std::size_t i = 0; i < order.size(); ++i) states[order[i]].rupture_velocity_m_s = speed_at(states, order, i);
    for (std::size_t i = from; i < to; ++i) {
      LocalState& s = states[i];
      if (s.subfault.rise_time && s.subfault.slip > 0) s.slip_velocity_m_s = s.subfault.slip / *s.subfault.rise_time;
      if (!s.rupture_velocity_m_s || *s.rupture_velocity_m_s >= e.speed) continue;
      const rupture::Relations r = rupture::from_rupture_velocity(*s.rupture_velocity_m_s / e.speed);
      s.stress = r.stress;
      if (!s.slip_velocity_m_s) continue;
      s.contact_ratio = *s.slip_velocity_m_s / medium::slip_velocity_unit(e.speed, r.slip_velocity);
      s.stress_pa = medium::stress_unit(e.shear_modulus, *s.contact_ratio) * r.stress;
    }
  }
  return states;
}

FasterThanC faster_than(const std::vector<LocalState>& states, double speed) {
  FasterThanC out;
  for (const LocalState& s : states) {
    if (!s.rupture_velocity_m_s) continue;
    ++out.timed;
    if (*s.rupture_velocity_m_s < speed) continue;
    ++out.subfaults;
    out.moment_share += s.subfault.moment_share;
  }
  return out;
}

std::string warning_of(const FasterThanC& faster, double speed) {
  if (faster.subfaults == 0) return {};
  return "subfaults that rupture faster than c = " + digits(speed, 4) + " m/s: " + std::to_string(faster.subfaults) +
         " of " + std::to_string(faster.timed) + ", with " + digits(100 * faster.moment_share, 3) + " % of the moment";
}

namespace {

constexpr double most_stress = 5;

/// The stress on one side of the hypocentre (`sign` is -1 or 1), with distances in units of `length`. The stress at the
/// hypocentre is interpolated between its neighbours. After the last column it is constant.
SideStress side_of(const FaultPulse& p, double sign, double length) {
  const std::size_t n = p.x.size();
  SideStress all;
  for (std::size_t j = 0; j < n; ++j) {
    const std::size_t i = sign > 0 ? j : n - 1 - j;
    all.distance.push_back(sign * p.x[i] / length);
    all.stress.push_back(p.stress[i]);
  }
  SideStress side{{0}, {0}};
  for (std::size_t i = 0; i < n; ++i) {
    if (all.distance[i] <= 0) {
      side.stress[0] = all.stress[i];
      continue;
    }
    if (side.distance.size() == 1 && i > 0 && all.distance[i - 1] < 0)
      side.stress[0] =
          std::lerp(all.stress[i - 1], all.stress[i], all.distance[i - 1] / (all.distance[i - 1] - all.distance[i]));
    if (i == 0) side.stress[0] = all.stress[i];
    side.distance.push_back(all.distance[i]);
    side.stress.push_back(all.stress[i]);
  }
  return side;
}

/// Computes one side, and fills the front time and the slip (in b / 2 pi) of its columns. The column at the hypocentre
/// gets the mean slip of both sides. The pulse has distances in units of `length` and times in length / c.
void run_side(FaultPulse& p, double sign, double length, double speed) {
  const SideStress stress = side_of(p, sign, length);
  if (stress.distance.size() < 2) return;
  const double end = p.end * speed / length;
  const HeldSide side(stress, end);
  const bool starts = stress.stress[0] >= least_stress;  // otherwise there is no stress drop that could start a pulse
  std::optional<pulse::Solver> solver;
  if (starts) {
    solver.emplace(side.problem());
    solver->advance_to(end);
  }
  const auto view = solver ? std::optional(solver->view()) : std::nullopt;
  for (std::size_t i = 0; i < p.x.size(); ++i) {
    const double distance = sign * p.x[i] / length;
    if (distance < 0) continue;
    const double time = side.front_time(distance) * length / speed;
    if (starts && std::isfinite(time)) p.front_time[i] = time;
    const double slip = view ? solver->slip_at(*view, -distance) : 0;
    const bool both = distance == 0 && p.x.front() < 0 && p.x.back() > 0;
    p.pulse_slip[i] += slip * (both ? 0.5 : 1);
  }
}

std::optional<double> correlation(const std::vector<double>& a, const std::vector<double>& b) {
  const double n = static_cast<double>(a.size());
  const double ma = std::accumulate(a.begin(), a.end(), 0.0) / n, mb = std::accumulate(b.begin(), b.end(), 0.0) / n;
  double aa = 0, ab = 0, bb = 0;
  for (std::size_t i = 0; i < a.size(); ++i)
    aa += (a[i] - ma) * (a[i] - ma), ab += (a[i] - ma) * (b[i] - mb), bb += (b[i] - mb) * (b[i] - mb);
  if (!(aa > 0 && bb > 0)) return std::nullopt;
  return ab / std::sqrt(aa * bb);
}

/// Scales the slip of the pulse to that of the model by least squares. With lengths in units of `length`, u = 1 is a
/// slip of A length / pi between both faces, so we obtain A from the factor.
void fit_slip(FaultPulse& p, double length) {
  p.correlation_of_slip = correlation(p.model_slip, p.pulse_slip);
  double both = 0, square = 0;
  for (std::size_t i = 0; i < p.x.size(); ++i)
    both += p.model_slip[i] * p.pulse_slip[i], square += p.pulse_slip[i] * p.pulse_slip[i];
  if (!(both > 0)) return;
  const double factor = both / square;
  for (double& slip : p.pulse_slip) slip *= factor;
  p.contact_ratio = 2 * std::numbers::pi * factor / (medium::face_factor * length);
}

/// The exact slip ahead of the front is 0, so any slip there is the error of the solver.
void measure_error(FaultPulse& p) {
  double ahead = 0, largest = 0;
  for (std::size_t i = 0; i < p.x.size(); ++i) {
    const double slip = std::fabs(p.pulse_slip[i]);
    largest = std::fmax(largest, slip);
    if (!p.front_time[i] || *p.front_time[i] > p.end) ahead = std::fmax(ahead, slip);
  }
  if (largest > 0) p.slip_error = ahead / largest;
}

/// Computes the ratio of mean front velocities from the mean rupture times, weighted with slip, over the columns that
/// have both times.
void compare_fronts(FaultPulse& p) {
  double model = 0, pulse = 0;
  for (std::size_t i = 0; i < p.x.size(); ++i) {
    if (p.front_time[i] && *p.front_time[i] <= p.end) ++p.reached;
    if (!p.front_time[i] || !p.model_time[i] || p.x[i] == 0) continue;
    model += p.model_slip[i] * *p.model_time[i];
    pulse += p.model_slip[i] * *p.front_time[i];
  }
  if (model > 0 && pulse > 0) p.front_velocity_ratio = model / pulse;
}

}  // namespace

double stress_by_slip(double event_stress, double share) {
  if (!(share > 0)) return 0;
  const double W = share * rupture::from_stress(event_stress).slip_velocity;
  if (W < rupture::from_stress(least_stress).slip_velocity) return 0;
  if (W > rupture::from_stress(most_stress).slip_velocity) return most_stress;
  return rupture::from_slip_velocity(W).stress;
}

FaultPulse pulse_along_fault(const std::vector<LocalState>& states, double stress, double speed) {
  const FaultColumns found = columns_of(states);
  FaultPulse p;
  p.reason = found.reason;
  if (!p.reason.empty()) return p;
  p.end = found.end;
  double slip = 0, square = 0;
  for (const FaultColumn& c : found.columns) slip += c.slip, square += c.slip * c.slip;
  for (const FaultColumn& c : found.columns) {
    p.x.push_back(c.x);
    p.model_slip.push_back(c.slip);
    p.model_time.push_back(std::isnan(c.rupture_time) ? std::nullopt : std::optional(c.rupture_time));
    p.stress.push_back(stress_by_slip(stress, c.slip * slip / square));
  }
  p.front_time.resize(p.x.size());
  p.pulse_slip.resize(p.x.size());
  const double length = p.x.back() - p.x.front();
  try {
    for (const double sign : {-1.0, 1.0}) run_side(p, sign, length, speed);
  } catch (const NumericsError& error) {
    FaultPulse none;
    none.reason = std::string("the pulse solver failed: ") + error.what();
    return none;
  }
  measure_error(p);
  fit_slip(p, length);
  compare_fronts(p);
  return p;
}

std::span<const PulseQuantity> pulse_quantities() {
  static constexpr PulseQuantity quantities[] = {
      {{"pulse_front_velocity_ratio", "velocity of the front, pulse over model", "", "Eqs. 6-7"},
       [](const FaultPulse& p) { return p.front_velocity_ratio; }},
      {{"pulse_correlation_of_slip", "correlation of slip along strike, pulse and model", "", "Eqs. 6-7"},
       [](const FaultPulse& p) { return p.correlation_of_slip; }},
      {{"pulse_columns", "columns of the model along strike", "", ""},
       [](const FaultPulse& p) { return std::optional(static_cast<double>(p.x.size())); },
       true},
      {{"pulse_columns_reached", "columns that the front of the pulse has reached", "", ""},
       [](const FaultPulse& p) { return std::optional(static_cast<double>(p.reached)); },
       true},
      {{"pulse_slip_error", "largest slip ahead of the front (exactly 0) over the largest slip", "", ""},
       [](const FaultPulse& p) { return p.slip_error; }},
      {{"pulse_contact_ratio", "A from the size of the slip in the model", "", "Eq. 1"},
       [](const FaultPulse& p) { return p.contact_ratio; }},
  };
  return quantities;
}

}  // namespace slipfront::finite_fault
