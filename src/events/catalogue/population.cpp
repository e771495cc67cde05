#include "events/catalogue/population.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "math/constants.hpp"
#include "slipfront/theory/rupture/relations.hpp"

namespace slipfront::catalogue {

namespace {

/// k with 10^k <= V < 10^(k + 1), whatever log10 rounds to.
int exponent_of(double V) {
  int k = static_cast<int>(std::floor(std::log10(V)));
  if (V >= std::pow(10.0, k + 1)) ++k;
  if (V < std::pow(10.0, k)) --k;
  return k;
}

double quantile(const std::vector<double>& sorted, double probability) {
  const double place = probability * static_cast<double>(sorted.size() - 1);
  const auto below = static_cast<std::size_t>(place);
  const auto above = std::min(below + 1, sorted.size() - 1);
  return std::lerp(sorted[below], sorted[above], place - static_cast<double>(below));
}

Spread spread_of(const std::vector<Member>& members, std::size_t quantity) {
  std::vector<double> values;
  for (const Member& m : members)
    if (!std::isnan(m.values[quantity])) values.push_back(m.values[quantity]);
  if (values.empty()) return {0, {none, none, none}};
  std::sort(values.begin(), values.end());
  return {values.size(), {quantile(values, 0.05), quantile(values, 0.5), quantile(values, 0.95)}};
}

}  // namespace

void Population::add(const Member& member) { members_[exponent_of(member.rupture_velocity)].push_back(member); }

std::vector<Decade> Population::decades() const {
  std::vector<Decade> all;
  if (members_.empty()) return all;
  const std::size_t quantities = members_.begin()->second.front().values.size();
  for (int k = members_.begin()->first; k <= members_.rbegin()->first; ++k) {
    Decade d{.exponent = k, .low = std::pow(10.0, k), .high = std::pow(10.0, k + 1), .middle = std::pow(10.0, k + 0.5)};
    const rupture::Relations closed_form = rupture::from_rupture_velocity(d.middle);
    d.stress = closed_form.stress;
    d.slip_velocity = closed_form.slip_velocity;
    const auto found = members_.find(k);
    static const std::vector<Member> nobody;
    const std::vector<Member>& members = found == members_.end() ? nobody : found->second;
    d.events = members.size();
    for (std::size_t i = 0; i < quantities; ++i) d.spread.push_back(spread_of(members, i));
    all.push_back(std::move(d));
  }
  return all;
}

std::vector<LinePoint> line_through(const std::vector<Decade>& decades) {
  std::vector<LinePoint> line;
  if (decades.empty()) return line;
  constexpr int points = 20;
  const int first = decades.front().exponent * points, last = (decades.back().exponent + 1) * points;
  for (int i = first; i <= last; ++i) {
    const auto r = rupture::from_rupture_velocity(std::min(0.99, std::pow(10.0, i / double{points})));
    line.push_back({r.rupture_velocity, r.stress, r.slip_velocity});
  }
  return line;
}

}  // namespace slipfront::catalogue
