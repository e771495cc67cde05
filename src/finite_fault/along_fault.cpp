#include "finite_fault/along_fault.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "foundation/text/digits.hpp"
#include "slipfront/medium/constants.hpp"
#include "slipfront/medium/medium.hpp"
#include "slipfront/rupture/relations.hpp"

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

/// Speed of the rupture at subfault i, by a plane through its rupture time and those of its eight nearest neighbours.
std::optional<double> speed_at(const std::vector<LocalState>& states, std::size_t i, std::size_t from, std::size_t to) {
  if (!states[i].subfault.rupture_time) return std::nullopt;
  const auto squared = [&](std::size_t j) {
    return std::pow(states[j].along_strike - states[i].along_strike, 2) +
           std::pow(states[j].down_dip - states[i].down_dip, 2);
  };
  std::vector<std::size_t> near;
  for (std::size_t j = from; j < to; ++j)
    if (j != i && states[j].subfault.rupture_time) near.push_back(j);
  const std::size_t count = std::min<std::size_t>(8, near.size());
  if (count < 3) return std::nullopt;
  std::partial_sort(near.begin(), near.begin() + static_cast<std::ptrdiff_t>(count), near.end(),
                    [&](std::size_t a, std::size_t b) { return squared(a) < squared(b); });
  double aa = 0, ab = 0, bb = 0, at = 0, bt = 0;
  for (std::size_t k = 0; k < count; ++k) {
    const LocalState& n = states[near[k]];
    const double a = n.along_strike - states[i].along_strike, b = n.down_dip - states[i].down_dip;
    const double t = *n.subfault.rupture_time - *states[i].subfault.rupture_time;
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
    for (std::size_t i = from; i < to; ++i) {
      LocalState& s = states[i];
      s.rupture_velocity_m_s = speed_at(states, i, from, to);
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

}  // namespace slipfront::finite_fault
