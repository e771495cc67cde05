#include "lattice/chain/explicit/first_levels.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "math/constants.hpp"

namespace slipfront::chain {
namespace {

/// A quantity on sites [low, high) of a chain. Around a ring they may be past its ends. There the field holds the
/// values of the sites themselves, so that the bits of a site do not depend on the piece that is computed.
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

/// Displacement and velocity at t = 0 of some sites and of three next to them on either side.
class StartFields {
 public:
  StartFields(const Problem& p, const MotionOf& start, long from, long to, StartCheck& check)
      : u(p, from, to, 3, turn * static_cast<double>(p.boundary.charge)), velocity(p, from, to, 3, 0) {
    const long n = static_cast<long>(p.grid.sites), low = std::max(0L, u.low()), high = std::min(n, u.high());
    fill(p, start, low, high, low, check);
    if (u.low() < 0) fill(p, start, n + u.low(), n, u.low(), check);
    if (u.high() > n) fill(p, start, 0, u.high() - n, n, check);
  }

  SiteField u, velocity;

 private:
  /// Sites [low, high) of the chain, from site `at` of the fields on.
  void fill(const Problem& p, const MotionOf& start, long low, long high, long at, StartCheck& check) {
    if (low >= high) return;
    const Motion m = sites_of(start, p, static_cast<std::size_t>(low), static_cast<std::size_t>(high));
    check.look(p, m, static_cast<std::size_t>(low));
    for (long j = low; j < high; ++j) {
      u[at + j - low] = m.u[static_cast<std::size_t>(j - low)];
      if (!m.velocity.empty()) velocity[at + j - low] = m.velocity[static_cast<std::size_t>(j - low)];
    }
  }
};

/// Derivatives of u in t at t = 0, from the equation of motion.
class Derivatives {
 public:
  Derivatives(const Problem& p, const Forces& forces, const StartFields& start, long from, long to)
      : forces_(forces),
        start_(start),
        lattice_(p.model == Model::lattice),
        h2_(p.grid.spacing * p.grid.spacing),
        C_(p.friction.linear_coefficient().value_or(0)),
        acceleration_(p, from, to, 1, 0),
        jerk_(p, from, to, 1, 0) {
    const SiteField &u = start.u, &w = start.velocity;
    for (long j = jerk_.low(); j < jerk_.high(); ++j) {
      acceleration_[j] = spring(u, j) - sine(j) + forces.now(j) - forces.friction(j, w[j]);
      jerk_[j] = spring(w, j) - cosine(j) * w[j] - C_ * acceleration_[j] + forces.rate(j);
    }
  }

  double contact(long j) const { return forces_.a2(j) == nullptr ? 1.0 : *forces_.a2(j); }

  /// u at t = -dt, by Taylor's series to dt^5.
  double earlier(long j, double dt) const {
    const double v = start_.velocity[j], a = acceleration_[j];
    const double fourth = acceleration_.bend(j) / h2_ - cosine(j) * a + sine(j) * v * v - C_ * jerk_[j];
    const double fifth =
        jerk_.bend(j) / h2_ - cosine(j) * jerk_[j] + sine(j) * 3 * v * a + cosine(j) * v * v * v - C_ * fourth;
    return start_.u[j] - dt * (v - dt / 2 * (a - dt / 3 * (jerk_[j] - dt / 4 * (fourth - dt / 5 * fifth))));
  }

 private:
  double cosine(long j) const { return contact(j) * std::cos(start_.u[j]); }
  double sine(long j) const { return contact(j) * std::sin(start_.u[j]); }
  double spring(const SiteField& v, long j) const { return (lattice_ ? v.bend(j) : v.fine_bend(j)) / h2_; }

  const Forces& forces_;
  const StartFields& start_;
  bool lattice_;
  double h2_, C_;
  SiteField acceleration_, jerk_;
};

}  // namespace

Levels first_levels(const Problem& p, const Scheme& s, const Forces& forces, const MotionOf& start, std::size_t begin,
                    std::size_t end, StartCheck& check) {
  const long n = static_cast<long>(p.grid.sites), from = static_cast<long>(begin), to = static_cast<long>(end);
  const StartFields fields(p, start, from, to, check);
  const Derivatives derivatives(p, forces, fields, from, to);
  const auto z = [&](long j, double u) { return (u + s.eps * derivatives.contact(j) * std::sin(u)) / turn; };
  Levels levels;
  for (long j = from; j < to; ++j) {
    const bool held = (j == 0 && !p.boundary.periodic && p.boundary.left == End::fixed) ||
                      (j + 1 == n && !p.boundary.periodic && p.boundary.right == End::fixed);
    levels.now.push_back(z(j, fields.u[j]));
    levels.before.push_back(held ? levels.now.back() : z(j, derivatives.earlier(j, s.dt)));
  }
  return levels;
}

}  // namespace slipfront::chain
