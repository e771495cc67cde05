#include "chain/explicit/start.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "foundation/text/digits.hpp"
#include "slipfront/error.hpp"

namespace slipfront::chain {
namespace {

constexpr double turn = 2 * std::numbers::pi;

/// A quantity on sites [low, high) of a chain. Around a periodic one they may lie beyond its ends; what is kept there
/// are the values of the sites themselves, so that no site's bits depend on the piece that it is computed with.
class SiteField {
 public:
  SiteField(const Problem& p, long begin, long end, long more, double jump)
      : boundary_(p.boundary),
        sites_(static_cast<long>(p.grid.sites)),
        low_(p.boundary.periodic ? begin - more : std::max(0L, begin - more)),
        high_(p.boundary.periodic ? end + more : std::min(sites_, end + more)),
        jump_(jump),
        values_(static_cast<std::size_t>(high_ - low_)) {}

  long low() const { return low_; }
  long high() const { return high_; }
  double& operator[](long j) { return values_[static_cast<std::size_t>(j - low_)]; }
  double operator[](long j) const { return values_[static_cast<std::size_t>(j - low_)]; }

  /// At site j + k, as the chain continues there seen from j.
  double operator()(long j, long k) const {
    const long i = j + k, last = sites_ - 1;
    if (boundary_.periodic) {
      const long around = turns(j) - turns(i);
      return around == 0 ? (*this)[i] : (*this)[i] + static_cast<double>(around) * jump_;
    }
    if (i < 0) return boundary_.left == End::fixed ? 2 * (*this)[0] - (*this)[-i] : (*this)[-i];
    if (i > last) {
      const double mirrored = (*this)[2 * last - i];
      return boundary_.right == End::fixed ? 2 * (*this)[last] - mirrored : mirrored;
    }
    return (*this)[i];
  }
  double bend(long j) const { return (*this)(j, 1) - 2 * (*this)[j] + (*this)(j, -1); }
  /// Second derivative times h^2, fourth order.
  double fine_bend(long j) const {
    return (16 * ((*this)(j, 1) + (*this)(j, -1)) - ((*this)(j, 2) + (*this)(j, -2)) - 30 * (*this)[j]) / 12;
  }

 private:
  long turns(long j) const { return j < 0 ? -1 : j >= sites_ ? 1 : 0; }

  Boundary boundary_;
  long sites_, low_, high_;
  double jump_;
  std::vector<double> values_;
};

/// Sites [begin, end) of a start, all of them there.
Motion part_of(const Problem& p, const MotionOf& start, long begin, long end) {
  Motion m = start(static_cast<std::size_t>(begin), static_cast<std::size_t>(end));
  const auto size = static_cast<std::size_t>(end - begin);
  if (m.u.size() != size || (!m.velocity.empty() && m.velocity.size() != size))
    throw InputError({.key = "initial motion",
                      .value = std::to_string(m.u.size()) + " sites",
                      .problem = "does not fit the grid",
                      .allowed = std::to_string(size) + " of " + std::to_string(p.grid.sites) + " sites"});
  return m;
}

}  // namespace

void StartCheck::look(const Problem& p, const Motion& m, std::size_t first) {
  for (std::size_t j = 0; j < m.u.size(); ++j) {
    if (!std::isfinite(m.u[j]) || (!m.velocity.empty() && !std::isfinite(m.velocity[j])))
      throw InputError({.key = "initial motion at x = " + digits(p.grid.x(first + j)),
                        .problem = "not a number",
                        .allowed = "finite displacement and velocity"});
    const double rise = j == 0 ? 0 : std::fabs(m.u[j] - m.u[j - 1]);
    if (rise > steepest_) {
      steepest_ = rise;
      at_ = p.grid.x(first + j);
    }
  }
}

void StartCheck::finish(const Problem& p, const Ranks& ranks) const {
  const std::vector<double> all = ranks.joined({steepest_, at_});
  double steepest = 0, at = 0;
  for (std::size_t r = 0; r < all.size(); r += 2) {
    if (!(all[r] > steepest)) continue;
    steepest = all[r];
    at = all[r + 1];
  }
  // A dislocation in a train has the greatest slope 2 beta, beta its inverse width.
  if (p.model == Model::sine_gordon && steepest > 2 / least_sites_per_width)
    ranks.together([&] {
      throw InputError(
          {.key = "spacing",
           .value = digits(p.grid.spacing),
           .problem = "too coarse: " + digits(2 / steepest) + " sites to the width of the dislocation at x = " +
                      digits(at) + ", " + digits(least_sites_per_width) + " are needed",
           .allowed = "about " + digits(p.grid.spacing * 2 / (least_sites_per_width * steepest)) + " or less"});
    });
}

void check_charge(const Problem& p, const MotionOf& start) {
  if (!p.boundary.periodic) return;
  const long n = static_cast<long>(p.grid.sites);
  const Motion first = part_of(p, start, 0, 1), last = part_of(p, start, n - 2, n);
  const double fits = (first.u[0] - (2 * last.u[1] - last.u[0])) / turn;
  if (std::fabs(fits - static_cast<double>(p.boundary.charge)) > 0.25)
    throw InputError({.key = "charge",
                      .value = std::to_string(p.boundary.charge),
                      .problem = "does not fit the initial state, which falls by " + digits(fits) + " turns",
                      .allowed = "the whole number of dislocations between the ends"});
}

Levels first_levels(const Problem& p, const Scheme& s, const Forces& forces, const MotionOf& start, std::size_t begin,
                    std::size_t end, StartCheck& check) {
  const long n = static_cast<long>(p.grid.sites), from = static_cast<long>(begin), to = static_cast<long>(end);
  const double h2 = s.h * s.h, dt = s.dt;
  const double C = p.friction.linear_coefficient().value_or(0);
  const auto contact = [&forces](long j) { return forces.a2(j) == nullptr ? 1.0 : *forces.a2(j); };
  const auto spring = [&](const SiteField& v, long j) {
    return (p.model == Model::lattice ? v.bend(j) : v.fine_bend(j)) / h2;
  };
  SiteField u(p, from, to, 3, turn * static_cast<double>(p.boundary.charge)), w(p, from, to, 3, 0);
  const auto fill = [&](long low, long high, long where) {  // sites [low, high), kept from `where` on
    if (low >= high) return;
    const Motion m = part_of(p, start, low, high);
    check.look(p, m, static_cast<std::size_t>(low));
    for (long j = low; j < high; ++j) {
      u[where + j - low] = m.u[static_cast<std::size_t>(j - low)];
      if (!m.velocity.empty()) w[where + j - low] = m.velocity[static_cast<std::size_t>(j - low)];
    }
  };
  const long low = std::max(0L, u.low()), high = std::min(n, u.high());
  fill(low, high, low);
  if (u.low() < 0) fill(n + u.low(), n, u.low());
  if (u.high() > n) fill(0, u.high() - n, n);

  SiteField acceleration(p, from, to, 1, 0), jerk(p, from, to, 1, 0);
  const auto cosine = [&](long j) { return contact(j) * std::cos(u[j]); };
  const auto sine = [&](long j) { return contact(j) * std::sin(u[j]); };
  for (long j = jerk.low(); j < jerk.high(); ++j) {
    acceleration[j] = spring(u, j) - sine(j) + forces.now(j) - forces.friction(j, w[j]);
    jerk[j] = spring(w, j) - cosine(j) * w[j] - C * acceleration[j] + forces.rate(j);
  }
  Levels levels;
  const auto z = [&](long j, double value) { return (value + s.eps * contact(j) * std::sin(value)) / turn; };
  for (long j = from; j < to; ++j) {
    const double v = w[j], a = acceleration[j];
    const double fourth = acceleration.bend(j) / h2 - cosine(j) * a + sine(j) * v * v - C * jerk[j];
    const double fifth =
        jerk.bend(j) / h2 - cosine(j) * jerk[j] + sine(j) * 3 * v * a + cosine(j) * v * v * v - C * fourth;
    const bool held = (j == 0 && !p.boundary.periodic && p.boundary.left == End::fixed) ||
                      (j + 1 == n && !p.boundary.periodic && p.boundary.right == End::fixed);
    const double earlier = u[j] - dt * (v - dt / 2 * (a - dt / 3 * (jerk[j] - dt / 4 * (fourth - dt / 5 * fifth))));
    levels.now.push_back(z(j, u[j]));
    levels.before.push_back(held ? levels.now.back() : z(j, earlier));
  }
  return levels;
}

}  // namespace slipfront::chain
