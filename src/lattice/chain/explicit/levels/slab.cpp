#include "lattice/chain/explicit/levels/slab.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "math/constants.hpp"
#include "math/roots.hpp"
#include "slipfront/math/elliptic.hpp"

namespace slipfront::chain {
namespace {

/// The slope of a train of dislocations as a function of its displacement u (Eq. 4):
///     u_x^2 = 4 C (sinh^2 psi + sin^2(u / 2)),    C = a^2 cosh^2 phi,    hence u_xx = C sin u.
struct Profile {
  double C, sinh_psi;

  double slope(double u) const { return -2 * std::sqrt(C) * std::hypot(sinh_psi, std::sin(u / 2)); }
  /// The change of u over a distance of at most a spacing, by a Taylor series to the fifth power of the distance.
  double change(double u, double distance) const {
    const double s = C * std::sin(u), c = C * std::cos(u), first = slope(u), first2 = first * first;
    const double fourth = s * (c - first2), fifth = first * (c * (c - first2) - 3 * s * s);
    return distance *
           (first + distance / 2 * (s + distance / 3 * (c * first + distance / 4 * (fourth + distance / 5 * fifth))));
  }
};

/// The values of phi for which shocks are tabulated; they are evenly spaced in ln phi.
constexpr double least_phi = 1e-12, most_phi = 2.7;
constexpr int phi_steps = 400;
const double log_step = std::log(most_phi / least_phi) / phi_steps;

/// (p - p0)(l - l0) + U M for a state next to the train at rest with psi0. It is 0 behind a shock
/// (docs/theory/3_modulation.md 3.4).
double jump(double phi, double psi, double psi0) {
  const elliptic::AtPsi at = elliptic::at_psi(psi), at0 = elliptic::at_psi(psi0);
  const double rise = 2 * std::sinh(psi - psi0) * std::sinh(psi + psi0);  // 2 sinh^2 psi minus 2 sinh^2 psi0
  const double l = 2 * at.K / (std::cosh(phi) * std::cosh(psi)), l0 = 2 * at0.K / std::cosh(psi0);
  return rise * (l - l0) + std::tanh(phi) * 8 * std::sinh(phi) * std::cosh(psi) * at.E;
}

}  // namespace

std::shared_ptr<const std::vector<double>> AbsorbingEnd::shocks_into(double psi0) {
  std::vector<double> gains;
  for (int i = 0; i <= phi_steps; ++i) {
    const double phi = least_phi * std::exp(i * log_step);
    const auto is_shock = [&](double gain) { return jump(phi, psi0 + gain, psi0) > 0; };
    // psi - psi0 would be phi in a fan.
    gains.push_back(jump(phi, psi0 + phi, psi0) < 0 ? bisected({.holding = 0, .failing = phi}, is_shock).failing : phi);
  }
  return std::make_shared<const std::vector<double>>(std::move(gains));
}

double AbsorbingEnd::psi_at(double phi) const {
  if (phi <= least_phi) return std::fmax(0, psi0 + phi);
  const double at = std::fmin(std::log(phi / least_phi) / log_step, phi_steps - 1e-9), floor = std::floor(at);
  const auto i = static_cast<std::size_t>(floor);
  return psi0 + (*shock)[i] + (at - floor) * ((*shock)[i + 1] - (*shock)[i]);
}

double AbsorbingEnd::displacement(double z) const {
  const double strength = eps * a * a;
  double u = z - strength * std::sin(z);
  for (int i = 0; i < 3; ++i) u -= (u + strength * std::sin(u) - z) / (1 + strength * std::cos(u));
  return u;
}

/// Velocity U of the dislocations next to the end, from u_t = -U u_x. It is 0 if there are none.
double AbsorbingEnd::velocity_of_train(const double* now, const double* next) const {
  // The sum begins at the second site from the end, because the end itself has no next level yet.
  double risen = 0, passed = 0;
  for (std::size_t i = 2; i <= reach; ++i) {
    const std::ptrdiff_t j = -outward * static_cast<std::ptrdiff_t>(i);
    risen += (next[j] - now[j]) * h / dt;
    passed += ((now[j - 1] + next[j - 1]) - (now[j + 1] + next[j + 1])) / 4;
  }
  constexpr double few = 0.1;  // a fraction of a dislocation; with fewer, U tends to 0
  const double U = risen * passed / (passed * passed + few * few);
  return std::fmax(-0.99, std::fmin(0.99, U));
}

AbsorbingEnd::Step AbsorbingEnd::step(const double* now, const double* next) const {
  const double z = turn * now[0], inner = turn * now[-outward], u = displacement(z);
  if (!(psi0 > 0)) {  // there is no train outside
    const double gained = dt / h * (inner - z), after = displacement(z + gained);
    // The flux at the end uses one-sided slopes of second order. The slope half a spacing inwards would be of first
    // order.
    const auto falls = [&](const double* level, double at_end) {
      return (4 * displacement(turn * level[-outward]) - 3 * at_end - displacement(turn * level[-outward - outward])) /
             (2 * h);
    };
    return {now[0] + gained / turn, (falls(now, u) + falls(next, after)) / 2 * (after - u)};
  }
  const double U = velocity_of_train(now, next), phi = std::atanh(U), cosh_phi = std::cosh(phi);
  const Profile train{a * a * cosh_phi * cosh_phi, std::sinh(psi_at(outward * phi))};
  const auto of = [&](double displacement) { return displacement + eps * a * a * std::sin(displacement); };
  const double carried = of(u + train.change(u, -U * dt)) - z;
  const double neighbour = of(u + train.change(u, -outward * h)) - z;
  const double gained = carried + dt / h * ((inner - z) - neighbour);
  const double middle = displacement(z + gained / 2), rise = displacement(z + gained) - u;
  const double traction = -train.slope(middle) + outward * (rise / dt + U * train.slope(middle));
  return {now[0] + gained / turn, outward * traction * rise};
}

Slab::Slab(std::size_t begin, std::size_t size, const EndConditions& ends)
    : begin_(begin), size_(size), ends_(ends), now_(size + 2 * margin + lanes), old_(size + 2 * margin + lanes) {}

EndSites before_neighbours(const EndConditions& s, const double* next, std::size_t first, std::size_t last) {
  EndSites bare;
  if (s.left != EndCondition::joined) bare.left = next[first];
  if (s.left == EndCondition::seam) bare.left_of_seam = next[first - 1];
  if (s.right != EndCondition::joined) bare.right = next[last];
  if (s.right == EndCondition::seam) bare.right_of_seam = next[last + 1];
  return bare;
}

namespace {

/// A level just computed, for the site at an end and the sites on both ends of a seam.
struct LevelAtEnd {
  double spread, turns;
  const double *now, *y;
  double* next;

  /// Steps an absorbing end, and returns the energy that leaves.
  double absorb(const AbsorbingEnd& end, std::size_t j) const {
    const AbsorbingEnd::Step step = end.step(now + j, next + j);
    next[j] = step.next;
    return step.outflow;
  }
  /// The site to the left of the first is the last, across the seam. We add a turn to it for each dislocation.
  void first_of_chain(std::size_t j, double bare) const { next[j] = bare + spread * ((y[j - 1] + turns) + y[j + 1]); }
  void last_of_chain(std::size_t j, double bare) const { next[j] = bare + spread * (y[j - 1] + (y[j + 1] - turns)); }
};

void mend_left(const EndConditions& s, const EndSites& bare, const LevelAtEnd& level, std::size_t first,
               Outflow& outflow) {
  switch (s.left) {
    case EndCondition::free:
      level.next[first] = bare.left + level.spread * (level.y[first + 1] + level.y[first + 1]);
      break;
    case EndCondition::fixed:
      level.next[first] = level.now[first];
      break;
    case EndCondition::absorbing:
      outflow.left += level.absorb(s.absorbing_left, first);
      break;
    case EndCondition::seam:
      level.last_of_chain(first - 1, bare.left_of_seam);
      level.first_of_chain(first, bare.left);
      break;
    case EndCondition::joined:
      break;
  }
}

void mend_right(const EndConditions& s, const EndSites& bare, const LevelAtEnd& level, std::size_t last,
                Outflow& outflow) {
  switch (s.right) {
    case EndCondition::free:
      level.next[last] = bare.right + level.spread * (level.y[last - 1] + level.y[last - 1]);
      break;
    case EndCondition::fixed:
      level.next[last] = level.now[last];
      break;
    case EndCondition::absorbing:
      outflow.right += level.absorb(s.absorbing_right, last);
      break;
    case EndCondition::seam:
      level.last_of_chain(last, bare.right);
      level.first_of_chain(last + 1, bare.right_of_seam);
      break;
    case EndCondition::joined:
      break;
  }
}

}  // namespace

void mend_ends(const EndConditions& s, const EndSites& bare, double spread, const double* now, const double* y,
               double* next, std::size_t first, std::size_t last, Outflow& outflow) {
  const LevelAtEnd level{spread, s.turns, now, y, next};
  mend_left(s, bare, level, first, outflow);
  mend_right(s, bare, level, last, outflow);
}

}  // namespace slipfront::chain
