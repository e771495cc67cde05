#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "chain/explicit/parts.hpp"
#include "slipfront/error.hpp"

namespace slipfront::chain {
namespace {

constexpr double turn = 2 * std::numbers::pi;

}  // namespace

Window Chain::window(std::size_t begin, std::size_t end, double time) const {
  Parts& parts = *parts_;
  if (parts.implicit && begin < end && end <= parts.problem.grid.sites &&
      std::fabs(time - this->time()) <= 1e-9 * (1 + time))
    return parts.implicit->window(begin, end);
  if (!(begin < end) || end > parts.problem.grid.sites || !(std::fabs(time - this->time()) <= 1.0001 * dt()))
    throw InputError(
        {.key = "window", .problem = "outside the chain or its present step", .allowed = "sites of the chain, now"});
  parts.exchange();
  const std::size_t from = std::max(begin, parts.begin), to = std::min(end, parts.end);
  Window window;
  if (from < to) window = parts.window(from, to, time);
  window.begin = begin;
  if (parts.ranks.size() > 1)
    for (std::vector<double>* values : {&window.x, &window.u, &window.velocity, &window.stress})
      *values = parts.ranks.joined(*values);
  return window;
}

/// u / 2 pi and the force of the substrate on sites from `low` on, at three levels.
struct Chain::Parts::ThreeLevels {
  long low;
  std::vector<double> u_old, u_now, u_next, S_old, S_now, S_next;
};

/// Sites [from, to) with five beyond, more where an absorbing end looks at the sites beside it; the next level is
/// computed and thrown away.
Chain::Parts::ThreeLevels Chain::Parts::three_levels(std::size_t from, std::size_t to) const {
  const long n = static_cast<long>(problem.grid.sites);
  constexpr std::size_t beside = 5;
  const bool absorbs_left = from == 0 && sides.left == Side::absorbing;
  const bool absorbs_right = static_cast<long>(to) == n && sides.right == Side::absorbing;
  const std::size_t more_left = absorbs_right ? std::min(from, sides.beyond_right.reach + 3) : 0;
  const std::size_t more_right = absorbs_left ? std::min(end - to, sides.beyond_left.reach + 3) : 0;
  const std::size_t reach = beside + more_left;
  const std::size_t wide = reach + (to - from) + beside + more_right, room = wide + 4 * lanes;
  const long low = static_cast<long>(from) - static_cast<long>(reach);
  std::vector<double> z(room), old(room), next(room), y(room);
  for (std::size_t j = 0; j < wide; ++j) {
    const auto [a, b] = site(low + static_cast<long>(j));
    z[j + lanes] = a;
    old[j + lanes] = b;
  }
  Outflow unused;
  constexpr std::size_t edge = lanes + 2;  // two sites in, neighbours are there
  forces.level({}, low + 2, wide - 4, old.data() + edge, z.data() + edge, next.data() + edge, y.data() + edge, unused);
  if (!problem.boundary.periodic) {  // the ends by their own rule
    const auto at = [&](long j) { return static_cast<std::size_t>(j - low) + lanes; };
    if (absorbs_left) next[at(0)] = sides.beyond_left.step(&z[at(0)], &next[at(0)]).next;
    if (absorbs_right) next[at(n - 1)] = sides.beyond_right.step(&z[at(n - 1)], &next[at(n - 1)]).next;
  }
  const ContactField& changing = forces.contacts();
  const double *a2 = forces.a2(low), *a2_old = changing.acts() ? changing.before(low) : a2,
               *a2_next = changing.acts() ? changing.next(low) : a2;
  const PeriodicForce sine = substrate_force(0);
  const auto column = [&] { return std::vector<double>(wide); };
  ThreeLevels v{low, column(), column(), column(), column(), column(), column()};
  displacements(sine, scheme.eps, a2_old, old.data() + lanes, v.u_old.data(), v.S_old.data(), wide);
  displacements(sine, scheme.eps, a2, z.data() + lanes, v.u_now.data(), v.S_now.data(), wide);
  displacements(sine, scheme.eps, a2_next, next.data() + lanes, v.u_next.data(), v.S_next.data(), wide);
  return v;
}

Window Chain::Parts::window(std::size_t from, std::size_t to, double time) const {
  if (implicit) return implicit->window(from, to);
  const double dt = scheme.dt, h = scheme.h, tau = time - static_cast<double>(level) * dt;
  const ThreeLevels v = three_levels(from, to);
  const auto local = [&](std::size_t site) { return static_cast<std::size_t>(static_cast<long>(site) - v.low); };
  const double C = problem.friction.linear_coefficient().value_or(0);
  const auto rate = [&](std::size_t j) { return (v.u_next[j] - v.u_old[j]) / (2 * dt); };
  const auto stress = [&](const std::vector<double>& u, std::size_t j) {
    if (problem.model == Model::lattice) return (u[j - 1] - u[j + 1]) / (2 * h);
    return (45 * (u[j - 1] - u[j + 1]) - 9 * (u[j - 2] - u[j + 2]) + (u[j - 3] - u[j + 3])) / (60 * h);
  };
  Window window;
  window.begin = from;
  for (std::size_t at = from; at < to; ++at) {
    const std::size_t j = local(at);
    const double acceleration = (v.u_next[j] - 2 * v.u_now[j] + v.u_old[j]) / (dt * dt);
    // u_ttt from the equation of motion: what the central difference needs to be of fourth order.
    const double jerk = (rate(j + 1) - 2 * rate(j) + rate(j - 1)) / (h * h) - (v.S_next[j] - v.S_old[j]) / (2 * dt) -
                        C * acceleration + forces.rate(static_cast<long>(at)) / turn;
    const double velocity = rate(j) - dt * dt / 6 * jerk;
    const double stress_rate = (stress(v.u_next, j) - stress(v.u_old, j)) / (2 * dt);
    window.x.push_back(problem.grid.x(at));
    window.u.push_back(turn * (v.u_now[j] + tau * (velocity + tau / 2 * (acceleration + tau / 3 * jerk))));
    window.velocity.push_back(turn * (velocity + tau * (acceleration + tau / 2 * jerk)));
    window.stress.push_back(turn * (stress(v.u_now, j) + tau * stress_rate));
  }
  // A fixed end stays where it is held: the equation of motion above knows nothing of what holds it.
  const auto hold = [&](std::size_t site) {
    window.u[site - from] = turn * v.u_now[local(site)];
    window.velocity[site - from] = 0;
  };
  if (from == 0 && sides.left == Side::fixed) hold(0);
  if (to == problem.grid.sites && sides.right == Side::fixed) hold(to - 1);
  return window;
}

}  // namespace slipfront::chain
