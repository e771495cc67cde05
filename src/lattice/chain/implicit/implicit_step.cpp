#include "lattice/chain/implicit/implicit_step.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>

#include "system/team.hpp"

namespace slipfront::chain {

namespace {

constexpr std::size_t together = 64;  ///< sites in one pass of the friction loops
constexpr double accuracy = 1e-6;     ///< relative change of a velocity that has converged

}  // namespace

ImplicitStep::ImplicitStep(const SiteForces& forces, int threads)
    : forces_(forces),
      springs_(forces.springs()),
      friction_law_(forces.problem().friction),
      threads_(threads),
      matrix_(forces.sites()) {
  for (auto* column : {&w_, &shift_, &friction_, &friction_slope_, &forcing_, &right_, &errors_})
    column->resize(forces.sites());
  for (auto* column : {&per_weight_, &force_, &slope_, &middle_}) *column = Bordered(forces.sites());
}

template <class Each>
void ImplicitStep::for_sites(const Each& each) const {
  for_each_on_team(sites(), sites() > 20000 ? threads_ : 1, each);
}

/// Calls each(first, size) for all sites, in groups.
template <class Each>
void ImplicitStep::for_groups(const Each& each) const {
  for_each_on_team((sites() + together - 1) / together, sites() > 20000 ? threads_ : 1, [&](std::size_t group) {
    const std::size_t first = group * together;
    each(first, std::min(together, sites() - first));
  });
}

/// Friction at the state of the middle of the step, which has evolved at the mean velocity, where contacts change. It
/// includes the force by which the substrate exceeds that of the start of the step.
double ImplicitStep::friction_at(std::size_t j, double w, double dt) const {
  SiteForces::State values;
  const double p = from_->v[j] + gain(j, w) / 2;
  const double force = friction_law_.force(w, forces_.evolved(*from_, j, p, dt / 2, values));
  const SiteForces::Aged then = forces_.aged(*from_, j, p, dt);
  const double more = (then.a2 - forces_.contact_squared(*from_, j)) / 2;
  return then.share * force + (more == 0 ? 0 : more * mean_sine(from_->u[j] + dt * p / 2, dt * p / 2));
}

/// Friction on a group of sites at the velocities w, with the state of the middle of the step.
void ImplicitStep::find_friction(std::size_t first, std::size_t size, const double* w, double dt, double* force) const {
  if (forces_.contacts_change()) {
    for (std::size_t i = 0; i < size; ++i) force[i] = friction_at(first + i, w[i], dt);
    return;
  }
  double speed[together], state[together * friction::most_variables];
  const std::size_t variables = forces_.variables();
  if (variables > 0) {
    double mean[together] = {};
    for (std::size_t i = 0; i < size; ++i) mean[i] = from_->v[first + i] + gain(first + i, w[i]) / 2;
    std::copy_n(from_->state.data() + variables * first, variables * size, state);
    friction_law_.evolution().advance_all(size, friction::Slips::at(mean), dt / 2, {state, variables});
  }
  for (std::size_t i = 0; i < size; ++i) speed[i] = std::fabs(w[i]);
  friction_law_.loops().strengths(size, speed, {state, variables}, force);
  for (std::size_t i = 0; i < size; ++i) force[i] = w[i] == 0 ? 0 : std::copysign(force[i], w[i]);
}

/// Computes friction on a group of sites, and its slope.
void ImplicitStep::rub(std::size_t first, std::size_t size, double dt) {
  double moved[together] = {}, change[together], force[together];
  const double* const w = w_.data() + first;
  for (std::size_t i = 0; i < size; ++i) {
    change[i] = SiteForces::difference(w[i]);
    moved[i] = w[i] + change[i];
  }
  find_friction(first, size, w, dt, friction_.data() + first);
  find_friction(first, size, moved, dt, force);
  for (std::size_t i = 0; i < size; ++i) friction_slope_[first + i] = (force[i] - friction_[first + i]) / change[i];
}

void ImplicitStep::evaluate_all(double dt) {
  for_groups([&](std::size_t first, std::size_t size) {
    if (forces_.rubs()) rub(first, size, dt);
    for (std::size_t j = first; j < first + size; ++j) evaluate(j, dt);
  });
}

/// Guesses velocities, and chooses the velocity that friction feels.
void ImplicitStep::prepare(const ChainState& from, double dt) {
  from_ = &from;
  for (std::size_t j = 0; j < sites(); ++j)  // formulas are called from one thread
    forcing_[j] = forces_.given_forcing(j, from.time + dt / 2);
  drives_ = forces_.drives_of_ends(from.time + dt / 2);
  double largest = 0;
  for (const double u : from.u) largest = std::fmax(largest, std::fabs(u));
  largest = forces_.ranks().largest(largest);
  rounding_ = 1e-13 + 4 * std::numeric_limits<double>::epsilon() * largest / (springs_.spacing() * springs_.spacing());
  for_sites([&](std::size_t j) {
    const double z = dt * std::fmax(from.slope[j], 0.0), eta = from.steps == 0 ? 0 : z / (3 * (1 + z));
    per_weight_[j] = 2 / (1 + eta);
    shift_[j] = eta / 2 * dt * from.acceleration[j];
    w_[j] = springs_.held(j) ? 0 : z > 1 ? from.w[j] : from.v[j] + dt / 2 * from.acceleration[j];
  });
}

/// The force on a site from all but its neighbours, (v' - v) / dt + S + f - F, and its slope in w. Call `rub` first.
void ImplicitStep::evaluate(std::size_t j, double dt) {
  if (springs_.held(j)) {
    force_[j] = springs_.held_force(j) - (springs_.at_left_end(j) ? drives_.left : drives_.right);
    slope_[j] = 1;
    middle_[j] = from_->u[j];
    return;
  }
  const double gained = gain(j, w_[j]), p = from_->v[j] + gained / 2, half = dt * p / 2;
  const double a2 = forces_.contact_squared(*from_, j), K = forces_.pull(j), middle = from_->u[j] + half;
  const double pulled = K * forces_.stretch(j, middle, from_->time + dt / 2);
  double force = gained / dt - forcing_[j] - pulled, by_p = K * dt / 2;
  if (a2 > 0) {
    const Sinc s = sinc(half);
    const double sine = std::sin(middle), cosine = std::cos(middle);
    force += a2 * sine * s.value;
    by_p += a2 * dt / 2 * (cosine * s.value + sine * s.slope);
  }
  double slope = per_weight_[j] * (1 / dt + by_p / 2);
  if (forces_.rubs()) {
    force += friction_[j];
    slope += friction_slope_[j];
  }
  force_[j] = force;
  slope_[j] = slope;
  middle_[j] = middle;
}

/// The velocity of a site to which Newton's method gives `change`, if friction is not taken as linear in between:
/// w + f(w) / A is the result of the linear step, with A the slope of all other forces. Friction that is a logarithm of
/// the velocity changes it by many decades at a time, up or down, which no linear step follows.
double ImplicitStep::velocity_under_friction(std::size_t j, double change, double dt) const {
  const double w = w_[j];
  const double by_springs = dt * per_weight_[j] / (2 * springs_.spacing() * springs_.spacing());
  const double weight = 1 / std::fmax(slope_[j] - friction_slope_[j] + by_springs, per_weight_[j] / (2 * dt));
  SiteForces::State values;
  const std::span<const double> state = forces_.evolved(*from_, j, mean_velocity(j), dt / 2, values);
  // The force of contacts that change belongs to the other forces here.
  const bool changes = forces_.contacts_change();
  const double share = changes ? forces_.aged(*from_, j, mean_velocity(j), dt).share : 1;
  const double f = changes ? share * friction_law_.force(w, state) : friction_[j];
  const double linear = w + weight * f + change * (1 + weight * friction_slope_[j]);
  return friction_law_.velocity_after(linear, weight * share, state);
}

/// Changes the velocities by Newton's method. They have converged if all sites have: in relative velocity, or in the
/// balance of forces to rounding. An absolute velocity would not do: friction may hold a site at 1e-20 and less, where
/// velocities that differ by all decades below 1e-13 mean forces of any size. A site that fails stops none of the
/// others, so that `hardest_position` does not depend on the ranks.
ImplicitStep::Outcome ImplicitStep::correct(double dt) {
  bool converged = true, failed = false;
  for (std::size_t j = 0; j < sites(); ++j) {
    const double change = right_[j], size = std::fabs(change);
    double& w = w_[j];
    if (!std::isfinite(change) || !std::isfinite(w)) {
      failed = true;
      continue;
    }
    if (springs_.held(j)) continue;
    converged = converged && (size <= accuracy * std::fabs(w) || size * std::fabs(slope_[j]) <= rounding_);
    const bool curved = forces_.rubs() && size > 0.3 * std::fabs(w) && friction_law_.steep_at_rest();
    w = curved ? velocity_under_friction(j, change, dt) : w + change;
    failed = failed || !std::isfinite(w);
  }
  const Outcome mine = failed ? Outcome::failed : converged ? Outcome::converged : Outcome::improved;
  return static_cast<Outcome>(forces_.ranks().largest(static_cast<double>(mine)));
}

void ImplicitStep::build_matrix(double dt) {
  const double m = springs_.coupling(), by_bend = dt / (4 * springs_.spacing() * springs_.spacing());
  springs_.exchange({&per_weight_, &force_, &slope_, &middle_});
  const auto column = [&](double slope, double per_weight, double spread, double bend) {
    return spread * slope - bend * by_bend * per_weight;
  };
  for_sites([&](std::size_t j) {
    if (springs_.held(j)) {
      matrix_.diagonal[j] = 1;
      matrix_.below[j] = matrix_.above[j] = right_[j] = 0;
      return;
    }
    const bool first = springs_.at_left_end(j), last = springs_.at_right_end(j);
    const double left = last ? 2 : 1, right = first ? 2 : 1;
    const bool no_left = first || (j > 0 && springs_.held(j - 1)), no_right = last || springs_.held(j + 1);
    matrix_.diagonal[j] = column(slope_[j], per_weight_[j], 1 - 2 * m, -2);
    matrix_.below[j] = no_left ? 0 : column(slope_.before(j), per_weight_.before(j), left * m, left);
    matrix_.above[j] = no_right ? 0 : column(slope_.after(j), per_weight_.after(j), right * m, right);
    right_[j] = springs_.bend(middle_, j) - springs_.spread(force_, j);
  });
}

bool ImplicitStep::solve(const ChainState& from, double dt) {
  constexpr int most_iterations = 40;
  prepare(from, dt);
  for (int iteration = 0; iteration < most_iterations; ++iteration) {
    evaluate_all(dt);
    build_matrix(dt);
    matrix_.solve(right_, springs_.periodic(), forces_.ranks());
    const Outcome outcome = correct(dt);
    if (outcome == Outcome::failed) return false;
    if (outcome == Outcome::improved) continue;
    evaluate_all(dt);
    return true;
  }
  return false;
}

/// Error of the mean velocity of a step at a site that friction holds. Its velocity follows the force, as the
/// exponential of it under rate-and-state friction: it may rise by many decades in a step that moves nothing until its
/// last part. The logarithm of the velocity is taken as a straight line through the middles of the last two steps.
double ImplicitStep::creep_error(std::size_t j, double dt) const {
  const double w = w_[j], before = from_->w[j], ratio = w / before;
  if (!forces_.rubs() || !(dt * friction_slope_[j] > 1) || !(ratio > 0)) return 0;
  const double x = std::fmin(std::fabs(std::log(ratio)) * dt / (dt + from_->last_step), 300.0);  // half in the step
  const double mean = std::fabs(w) * (x < 1e-3 ? 1 + x * x / 6 : std::sinh(x) / x);
  return std::fabs(mean - std::fabs(w));
}

/// Errors of the logarithm of the state variables, if the mean velocities have the errors `by_velocity`.
void ImplicitStep::find_state_errors(std::size_t first, std::size_t size, double dt, const double* by_velocity,
                                     double* error) const {
  const std::size_t variables = forces_.variables();
  const double* const start = from_->state.data() + variables * first;
  double p[together] = {}, one[together * friction::most_variables], other[together * friction::most_variables];
  const auto evolve = [&](double* state) {
    std::copy_n(start, variables * size, state);
    friction_law_.evolution().advance_all(size, friction::Slips::at(p), dt, {state, variables});
  };
  const auto difference = [variables](const double* a, const double* b) {
    double most = 0;
    for (std::size_t k = 0; k < variables; ++k)
      most = std::fmax(most, a[k] > 0 && b[k] > 0 ? std::fabs(std::log(a[k] / b[k])) : std::fabs(a[k] - b[k]));
    return most;
  };
  for (std::size_t i = 0; i < size; ++i) p[i] = std::fabs(mean_velocity(first + i));
  evolve(one);
  for (std::size_t i = 0; i < size; ++i) {
    const double moved = difference(one + variables * i, start + variables * i);
    p[i] += by_velocity[i] + std::fabs(gain(first + i, w_[first + i])) / 12 * std::fmin(1, moved);
  }
  evolve(other);
  // The state counts forty times: near the critical stiffness, peak velocities are most sensitive to its errors.
  constexpr double weight = 40;
  for (std::size_t i = 0; i < size; ++i) error[i] = weight * difference(one + variables * i, other + variables * i);
}

/// The errors at a group of sites: that of the trapezoidal rule, dt^3 y''' / 12, by differences of the accelerations of
/// three steps, that of creep and that of the state.
void ImplicitStep::find_errors(std::size_t first, std::size_t size, double dt) {
  const double h1 = from_->last_step, h2 = from_->earlier_step;
  double by_velocity[together] = {}, by_state[together] = {};
  for (std::size_t i = 0; i < size; ++i) {
    const std::size_t j = first + i;
    const double jerk = (gain(j, w_[j]) / dt - from_->acceleration[j]) / ((dt + h1) / 2);
    const double before = (from_->acceleration[j] - from_->earlier[j]) / ((h1 + h2) / 2);
    const double snap = (jerk - before) / ((dt + 2 * h1 + h2) / 4), by_creep = creep_error(j, dt);
    errors_[j] = std::fmax(dt * dt * dt / 12 * std::fmax(std::fabs(jerk), std::fabs(snap)), dt * by_creep);
    by_velocity[i] = dt * dt * std::fabs(jerk) / 12 + by_creep;
  }
  if (forces_.variables() > 0) find_state_errors(first, size, dt, by_velocity, by_state);
  for (std::size_t i = 0; i < size; ++i) {
    const double worst = std::fmax(errors_[first + i], by_state[i]);
    errors_[first + i] = springs_.held(first + i) ? 0 : std::isfinite(worst) ? worst : HUGE_VAL;
  }
}

double ImplicitStep::error(const ChainState& from, double dt) {
  if (!(from.earlier_step > 0)) return 0.125;  // not known yet: grow carefully
  for_groups([&](std::size_t first, std::size_t size) { find_errors(first, size, dt); });
  const double most = *std::max_element(errors_.begin(), errors_.end());
  return forces_.ranks().largest(most) / forces_.problem().tolerance;
}

/// Adds the work of the step to that of the blocks. Friction includes the force of growing contacts, which belongs to
/// the substrate.
void ImplicitStep::add_energies(ChainState& m, double dt) const {
  const OwnBlocks& own = forces_.own();
  for (std::size_t b = 0; b < own.count; ++b) {
    double work = 0, lost = 0, given = 0;
    for (std::size_t j = own.begin_of(b); j < own.begin_of(b + 1); ++j) {
      const Works at = works_at(m, j, dt);
      work += at.supplied;
      lost += at.dissipated;
      given += at.by_contacts;
    }
    m.flows[3 * b] += work;
    m.flows[3 * b + 1] += lost;
    m.flows[3 * b + 2] += given;
  }
}

ImplicitStep::Works ImplicitStep::works_at(const ChainState& m, std::size_t j, double dt) const {
  const bool held = springs_.held(j);
  const double p = held ? 0 : mean_velocity(j), weight = springs_.weight(j), K = forces_.pull(j);
  Works at;
  at.supplied = weight * dt * (forcing_[j] + springs_.drive(j, drives_.left, drives_.right)) * p;
  if (K > 0) {
    const double stretch = forces_.stretch(j, m.u[j] + dt * p / 2, m.time + dt / 2);
    at.supplied += weight * dt * K * forces_.pulled_at(j) * stretch;
  }
  if (held) return at;
  if (forces_.rubs()) at.dissipated = weight * dt * friction_[j] * p;
  if (!forces_.has_changing_contacts()) return at;
  const double middle = m.u[j] + dt * p / 2, change = forces_.aged(m, j, p, dt).a2 - m.a2[j];
  const double sine = mean_sine(middle, dt * p / 2);
  at.dissipated -= weight * change / 2 * sine * dt * p;
  at.by_contacts = weight * change * (1 - std::cos(middle) * std::cos(dt * p / 2));
  return at;
}

void ImplicitStep::take(ChainState& m, double dt) const {
  add_energies(m, dt);
  for_sites([&](std::size_t j) {
    if (springs_.held(j)) return;
    const double p = mean_velocity(j), next = next_velocity(j);
    forces_.evolve(m, j, p, dt);
    m.earlier[j] = m.acceleration[j];
    m.acceleration[j] = (next - m.v[j]) / dt;
    m.slope[j] = forces_.rubs() ? friction_slope_[j] : 0;
    m.w[j] = w_[j];
    m.u[j] += dt * p;
    m.v[j] = next;
  });
  m.earlier_step = m.last_step;
  m.last_step = dt;
  ++m.steps;
}

double ImplicitStep::hardest_position() const {
  std::size_t site = 0;
  const auto imbalance = [this](std::size_t j) {
    return std::fabs(right_[j]) > accuracy * std::fabs(w_[j]) ? std::fabs(right_[j] * slope_[j]) : 0;
  };
  for (std::size_t j = 0; j < sites() && std::isfinite(force_[site]); ++j)
    if (!(std::fabs(force_[j]) < HUGE_VAL) || imbalance(j) > imbalance(site)) site = j;
  const double most = std::isfinite(force_[site]) ? imbalance(site) : HUGE_VAL;
  const std::vector<double> all = forces_.ranks().joined({most, forces_.x(site)});
  std::size_t hardest = 0;
  for (std::size_t i = 0; i < all.size(); i += 2)
    if (all[i] > all[hardest]) hardest = i;
  return all[hardest + 1];
}

}  // namespace slipfront::chain
