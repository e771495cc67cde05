#include "lattice/chain/explicit/explicit_chain.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>
#include <vector>

#include "lattice/chain/explicit/share.hpp"
#include "lattice/chain/model/initial_train.hpp"
#include "math/constants.hpp"
#include "math/simd/vector_code.hpp"
#include "slipfront/error.hpp"
#include "system/archive.hpp"

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

/// The two levels, at 0 and -dt, of sites [begin, end) of a motion given by u and velocity at t = 0: Taylor in t to
/// dt^5, derivatives from the equation of motion.
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

/// Pieces of levels that a caller holds whole.
LevelsOf pieces_of(const Levels& saved, std::size_t sites) {
  return [&saved, sites](std::size_t begin, std::size_t end) -> Levels {
    if (saved.now.size() != sites || saved.before.size() != sites)
      throw InputError({.key = "resume",
                        .value = std::to_string(saved.now.size()) + " sites",
                        .problem = "does not fit the scenario",
                        .allowed = std::to_string(sites) + " sites"});
    const auto part = [](const std::vector<double>& all, std::size_t from, std::size_t to) {
      const auto at = [&](std::size_t j) { return all.begin() + static_cast<std::ptrdiff_t>(j); };
      return std::vector<double>(at(from), at(to));
    };
    const std::size_t variables = saved.state.size() / sites;
    return {saved.level, part(saved.now, begin, end), part(saved.before, begin, end),
            part(saved.state, variables * begin, variables * end)};
  };
}

}  // namespace

ExplicitChain::ExplicitChain(const Problem& p, const MotionOf& start, const Execution& execution)
    : Chain(p, execution.ranks), execution_(execution) {
  StartCheck look;
  ranks().together([&] {
    check(p, ranks().share_of_machine());
    share_ = std::make_unique<RankSites>(p, execution, ranks(), 0);
    share_->fill([&](std::size_t begin, std::size_t end) {
      return first_levels(p, share_->scheme(), share_->forces(), start, begin, end, look);
    });
  });
  look.finish(p, ranks());
  ranks().together([&] { check_charge(p, start); });
}

ExplicitChain::ExplicitChain(const Problem& p, long level, const LevelsOf& saved, const Execution& execution)
    : Chain(p, execution.ranks), execution_(execution) {
  start_from(level, saved);
}

ExplicitChain::ExplicitChain(const Problem& p, const Motion& start, const Execution& execution)
    : ExplicitChain(p, pieces_of(start, p.grid.sites), execution) {}
ExplicitChain::ExplicitChain(const Problem& p, const Levels& saved, const Execution& execution)
    : ExplicitChain(p, saved.level, pieces_of(saved, p.grid.sites), execution) {}

ExplicitChain::~ExplicitChain() = default;
ExplicitChain::ExplicitChain(ExplicitChain&&) noexcept = default;

void ExplicitChain::start_from(long level, const LevelsOf& saved) {
  constexpr long most = no_limit / 2;  // the levels after it are numbers too
  ranks().together([&] {
    check(problem(), ranks().share_of_machine());
    if (!(level >= 0 && level <= most))
      throw InputError(
          {.key = "resume", .value = std::to_string(level), .problem = "not a level", .allowed = "0 or greater"});
    share_ = std::make_unique<RankSites>(problem(), execution_, ranks(), level);
    share_->fill(saved);
  });
}

double ExplicitChain::dt() const { return share_->scheme().dt; }
double ExplicitChain::time() const { return share_->time(); }
long ExplicitChain::steps() const { return share_->level(); }

void ExplicitChain::advance(long levels) {
  valid_ = false;
  while (levels > 0) {
    const long some = std::min(levels, static_cast<long>(share_->depth()));
    share_->advance(static_cast<std::size_t>(some));
    ranks().together([this] { share_->check_numbers(); });
    levels -= some;
  }
  valid_ = true;
}

bool ExplicitChain::advance_to(double time, long most) {
  advance(std::min(std::lround(time / dt()) - steps(), most));
  return reached(time);
}

void ExplicitChain::exchange() const { share_->exchange(); }
Window ExplicitChain::own_window(std::size_t begin, std::size_t end, double time) const {
  return window_of(*share_, begin, end, time);
}

Flows ExplicitChain::flows() const { return share_->flows(); }
std::vector<double> ExplicitChain::flow_sums() const { return share_->flow_sums(); }

Levels ExplicitChain::levels(std::size_t begin, std::size_t end) const {
  Levels levels = share_->levels(begin, end);
  if (ranks().size() == 1) return levels;
  levels.now = ranks().joined_at_first(levels.now);
  levels.before = ranks().joined_at_first(levels.before);
  levels.state = ranks().joined_at_first(levels.state);
  return levels;
}

Levels ExplicitChain::levels() const {
  const std::size_t sites = problem().grid.sites;
  if (ranks().size() == 1) return levels(0, sites);
  Levels all;
  all.level = steps();
  constexpr std::size_t piece = std::size_t{1} << 26;  // the largest message
  for (std::size_t begin = 0; begin < sites; begin += piece) {
    const Levels some = levels(begin, std::min(begin + piece, sites));
    all.now.insert(all.now.end(), some.now.begin(), some.now.end());
    all.before.insert(all.before.end(), some.before.begin(), some.before.end());
    all.state.insert(all.state.end(), some.state.begin(), some.state.end());
  }
  return all;
}

void ExplicitChain::archive(Archive& a) {
  Levels all;
  std::vector<double> flows;
  if (!a.reads()) {
    all = levels();
    flows = flow_sums();
  }
  const std::vector<std::string> variables = state_names(problem());
  std::string names;
  for (const std::string& name : variables) names += name + " ";
  a.same(names);
  a(flows, all.level, all.state, all.now, all.before);
  a.require(all.state.size() == variables.size() * all.now.size());
  if (!a.reads()) return;
  start_from(all.level, pieces_of(all, problem().grid.sites));
  share_->continue_flows(flows);
  valid_ = true;
}

namespace {

/// z / 2 pi of `wide` sites from `low` on at three levels. The arrays begin `lanes` elements before.
struct Displaced {
  long low;
  std::size_t wide;
  std::vector<double> old, now, next;
};

/// Computes the next level, but for the two sites at either side.
void compute_next(const Forces& forces, Displaced& d) {
  const std::size_t room = d.now.size();
  std::vector<double> y(room), coefficients(forces.has_contact() ? PeriodicForce::terms * room : 0);
  LevelSites sites{.offset = d.low - static_cast<long>(lanes),
                   .left = lanes + 2,  // two sites in, neighbours are there
                   .right = lanes + d.wide - 2,
                   .before = d.old.data(),
                   .now = d.now.data(),
                   .next = d.next.data(),
                   .y = y.data()};
  if (!coefficients.empty()) {
    forces.contact_coefficients(sites.offset, lanes, lanes + (d.wide + lanes - 1) / lanes * lanes, coefficients.data());
    sites.coefficients = coefficients.data();
  }
  if (forces.variables() > 0) sites.states = {forces.state_of(sites.offset), forces.variables()};
  Outflow unused;
  forces.begin_level({}, sites, unused);
  forces.add_load_and_friction({}, sites);
}

/// Both levels of sites [from, to) and five on either side, or more where an absorbing end needs its neighbours; and
/// the next level, which is computed only for the window.
Displaced displaced(const RankSites& share, std::size_t from, std::size_t to) {
  const Problem& p = share.problem();
  const EndConditions& ends = share.ends();
  const long n = static_cast<long>(p.grid.sites);
  constexpr std::size_t beside = 5;
  const bool absorbs_left = from == 0 && ends.left == EndCondition::absorbing;
  const bool absorbs_right = static_cast<long>(to) == n && ends.right == EndCondition::absorbing;
  const std::size_t left = std::max(from, share.begin()) - share.begin(),
                    right = share.end() - std::min(to, share.end());
  const std::size_t more_left = absorbs_right ? std::min(left, ends.absorbing_right.reach + 3) : 0;
  const std::size_t more_right = absorbs_left ? std::min(right, ends.absorbing_left.reach + 3) : 0;
  const std::size_t reach = beside + more_left;
  const std::size_t wide = reach + (to - from) + beside + more_right, room = wide + 4 * lanes;
  const auto column = [room] { return std::vector<double>(room); };
  Displaced d{static_cast<long>(from) - static_cast<long>(reach), wide, column(), column(), column()};
  share.copy_levels(d.low, wide, d.old.data() + lanes, d.now.data() + lanes);
  compute_next(share.forces(), d);
  const auto at = [&](long j) { return static_cast<std::size_t>(j - d.low) + lanes; };
  if (absorbs_left) d.next[at(0)] = ends.absorbing_left.step(&d.now[at(0)], &d.next[at(0)]).next;
  if (absorbs_right) d.next[at(n - 1)] = ends.absorbing_right.step(&d.now[at(n - 1)], &d.next[at(n - 1)]).next;
  return d;
}

/// u / 2 pi and the force of the substrate on sites from `low` on, at three levels.
struct ThreeLevels {
  ThreeLevels(const RankSites& share, const Displaced& d) : low(d.low) {
    for (auto* values : {&u_old, &u_now, &u_next, &S_old, &S_now, &S_next}) values->resize(d.wide);
    const ContactField& changing = share.forces().contacts();
    const double *a2 = share.forces().a2(low), *a2_old = changing.acts() ? changing.before(low) : a2,
                 *a2_next = changing.acts() ? changing.next(low) : a2;
    const PeriodicForce& sine = share.forces().sine();
    const double eps = share.scheme().eps;
    displacements(sine, eps, a2_old, d.old.data() + lanes, u_old.data(), S_old.data(), d.wide);
    displacements(sine, eps, a2, d.now.data() + lanes, u_now.data(), S_now.data(), d.wide);
    displacements(sine, eps, a2_next, d.next.data() + lanes, u_next.data(), S_next.data(), d.wide);
  }

  std::size_t at(std::size_t site) const { return static_cast<std::size_t>(static_cast<long>(site) - low); }
  long low;
  std::vector<double> u_old, u_now, u_next, S_old, S_now, S_next;
};

/// The loops over the sites of a window, by `tau` after the present level.
struct WindowLoops {
  double dt, h, tau, C;
  std::size_t size;
  const double *u_old, *u_now, *u_next, *S_old, *S_next;  ///< at the first site; five more on either side of the window

  /// u and u_t. `F_t` is the rate of change of the force, in turns.
  void extrapolate(const double* F_t, double* u, double* velocity) const;
  void stress(Model model, double* stress) const;
};

SLIPFRONT_CLONES void WindowLoops::extrapolate(const double* F_t, double* u, double* velocity) const {
  const WindowLoops l = *this;
  const double per_step = 1 / (2 * l.dt), per_dt2 = 1 / (l.dt * l.dt), per_h2 = 1 / (l.h * l.h);
  const double *const left_next = l.u_next - 1, *const left_old = l.u_old - 1;
  SLIPFRONT_INDEPENDENT
  for (std::size_t j = 0; j < l.size; ++j) {
    const double rate = (l.u_next[j] - l.u_old[j]) * per_step;
    const double of_left = (left_next[j] - left_old[j]) * per_step;
    const double of_right = (left_next[j + 2] - left_old[j + 2]) * per_step;
    const double acceleration = (l.u_next[j] - 2 * l.u_now[j] + l.u_old[j]) * per_dt2;
    // u_ttt from the equation of motion: what the central difference needs to be of fourth order.
    const double jerk =
        (of_right - 2 * rate + of_left) * per_h2 - (l.S_next[j] - l.S_old[j]) * per_step - l.C * acceleration + F_t[j];
    const double v = rate - l.dt * l.dt / 6 * jerk;
    u[j] = turn * (l.u_now[j] + l.tau * (v + l.tau / 2 * (acceleration + l.tau / 3 * jerk)));
    velocity[j] = turn * (v + l.tau * (acceleration + l.tau / 2 * jerk));
  }
}

/// -h u_x from the differences of u at the neighbours at a distance of one, two and three sites.
[[gnu::always_inline]] inline double fall(const double* u, Model model) {
  if (model == Model::lattice) return (u[-1] - u[1]) / 2;
  return (45 * (u[-1] - u[1]) - 9 * (u[-2] - u[2]) + (u[-3] - u[3])) / 60;
}

SLIPFRONT_CLONES void WindowLoops::stress(Model model, double* stress) const {
  const WindowLoops l = *this;
  const double ahead = l.tau / (2 * l.dt), factor = turn / l.h;
  const Model kind = model;
  SLIPFRONT_INDEPENDENT
  for (std::size_t j = 0; j < l.size; ++j)
    stress[j] = factor * (fall(l.u_now + j, kind) + ahead * (fall(l.u_next + j, kind) - fall(l.u_old + j, kind)));
}

}  // namespace

Window window_of(const RankSites& share, std::size_t from, std::size_t to, double time) {
  const Problem& p = share.problem();
  const Forces& forces = share.forces();
  const ThreeLevels v(share, displaced(share, from, to));
  const std::size_t size = to - from, at = v.at(from);
  const auto column = [size](double value) { return std::vector<double>(size, value); };
  Window window{from, column(0), column(0), column(0), column(0), column(1), column(1)};
  const WindowLoops loops{.dt = share.scheme().dt,
                          .h = share.scheme().h,
                          .tau = time - share.time(),
                          .C = p.friction.linear_coefficient().value_or(0),
                          .size = size,
                          .u_old = &v.u_old[at],
                          .u_now = &v.u_now[at],
                          .u_next = &v.u_next[at],
                          .S_old = &v.S_old[at],
                          .S_next = &v.S_next[at]};
  std::vector<double> F_t = column(0);
  if (!forces.steady())
    for (std::size_t j = 0; j < size; ++j) F_t[j] = forces.rate(static_cast<long>(from + j)) / turn;
  loops.extrapolate(F_t.data(), window.u.data(), window.velocity.data());
  loops.stress(p.model, window.stress.data());
  for (std::size_t j = 0; j < size; ++j) window.x[j] = p.grid.x(from + j);
  const auto first = static_cast<long>(from);
  if (const double* a2 = forces.a2(first)) std::copy_n(a2, size, window.contact_squared.begin());
  if (forces.contacts().acts()) std::copy_n(forces.contacts().share(first), size, window.effective_stress.begin());
  // A fixed end stays at its displacement: the equation of motion above does not contain the force that holds it.
  const auto hold = [&](std::size_t site) {
    window.u[site - from] = turn * v.u_now[v.at(site)];
    window.velocity[site - from] = 0;
  };
  if (from == 0 && share.ends().left == EndCondition::fixed) hold(0);
  if (to == p.grid.sites && share.ends().right == EndCondition::fixed) hold(to - 1);
  return window;
}

}  // namespace slipfront::chain
