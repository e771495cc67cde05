#include "chain/implicit/implicit.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <exception>
#include <limits>
#include <span>
#include <string>

#include "foundation/text/digits.hpp"
#include "slipfront/error.hpp"

namespace slipfront::chain {
namespace {

/// sin(y) / y and its derivative.
struct Sinc {
  double value, slope;
};
Sinc sinc(double y) {
  const double y2 = y * y;
  if (y2 < 1e-3) return {1 - y2 / 6 * (1 - y2 / 20 * (1 - y2 / 42)), -y / 3 * (1 - y2 / 10 * (1 - y2 / 28))};
  const double s = std::sin(y) / y;
  return {s, (std::cos(y) - s) / y};
}

/// (cos u - cos u') / (u' - u), from their middle and half their difference.
double mean_sine(double middle, double half) { return std::sin(middle) * sinc(half).value; }

constexpr std::size_t most_variables = 4;
constexpr int most_iterations = 40;

}  // namespace

template <class Each>
void ImplicitSteps::for_sites(const Each& each) const {
  const auto n = static_cast<long>(n_);
  std::exception_ptr exception;  // by friction whose curve the user gave
#ifdef _OPENMP
#pragma omp parallel for num_threads(threads_) schedule(static) if (threads_ > 1 && n > 20000)
#endif
  for (long j = 0; j < n; ++j) {
    try {
      each(static_cast<std::size_t>(j));
    } catch (...) {
#ifdef _OPENMP
#pragma omp critical
#endif
      exception = std::current_exception();
    }
  }
  if (exception) std::rethrow_exception(exception);
}

ImplicitSteps::Aged ImplicitSteps::aged(std::size_t j, double p, double dt) const {
  const double theta = now_.memory[j], excess = now_.excess[j];
  double middle = theta, end = theta;
  problem_.friction.law().advance(p, dt / 2, {&middle, 1});
  problem_.friction.law().advance(p, dt, {&end, 1});
  const double after = contacts_.excess_after(dt, excess, theta, end);
  return {end, after, base_.empty() ? 0 : base_[j] * contacts_.strength(end, after),
          contacts_.share(contacts_.excess_after(dt / 2, excess, theta, middle))};
}

/// Friction at the state of the middle of the step, which has evolved at the mean velocity. Where contacts change, it
/// includes the force by which the substrate exceeds that of the start of the step.
double ImplicitSteps::friction_at(std::size_t j, double w, double dt) const {
  if (variables_ == 0) return problem_.friction.force(w);
  std::array<double, most_variables> middle;
  std::copy_n(&now_.memory[variables_ * j], variables_, middle.begin());
  const std::span<double> memory(middle.data(), variables_);
  const double p = now_.v[j] + gain(j, w) / 2;
  problem_.friction.law().advance(p, dt / 2, memory);
  const double force = problem_.friction.force(w, memory);
  if (!contacts_.act()) return force;
  const Aged then = aged(j, p, dt);
  const double more = (then.a2 - contact_squared(j)) / 2;
  return then.share * force + (more == 0 ? 0 : more * mean_sine(now_.u[j] + dt * p / 2, dt * p / 2));
}

/// The slope of friction at w, where friction is f, by a small difference.
double ImplicitSteps::friction_slope(std::size_t j, double w, double f, double dt) const {
  const double step = std::copysign(std::fmax(1e-6 * std::fabs(w), smallest_velocity), w);
  return (friction_at(j, w + step, dt) - f) / step;
}

/// Guesses velocities, and chooses the velocity that friction feels.
void ImplicitSteps::prepare(double dt) {
  const double middle = now_.time + dt / 2;
  for (std::size_t j = 0; j < n_; ++j)  // formulas are called from one thread
    trial_.forcing[j] = problem_.forcing ? problem_.forcing(problem_.grid.x(j), middle) : 0;
  double largest = 0;
  for (const double u : now_.u) largest = std::fmax(largest, std::fabs(u));
  rounding_ = 1e-13 + 4 * std::numeric_limits<double>::epsilon() * largest / (springs_.spacing() * springs_.spacing());
  for_sites([&](std::size_t j) {
    const double z = dt * std::fmax(now_.slope[j], 0.0), eta = now_.steps == 0 ? 0 : z / (3 * (1 + z));
    trial_.theta[j] = (1 + eta) / 2;
    trial_.shift[j] = eta / 2 * dt * now_.acceleration[j];
    trial_.w[j] = springs_.held(j) ? 0 : z > 1 ? now_.w[j] : now_.v[j] + dt / 2 * now_.acceleration[j];
  });
}

/// The force on a site from all but its neighbours, (v' - v) / dt + S + f - F, and its slope in w.
void ImplicitSteps::evaluate(std::size_t j, double dt) {
  if (springs_.held(j)) {
    trial_.force[j] = springs_.held_force(j);
    trial_.slope[j] = 1;
    trial_.middle[j] = now_.u[j];
    return;
  }
  const double theta = trial_.theta[j], w = trial_.w[j], p = mean_velocity(j), half = dt * p / 2;
  const double a2 = contact_squared(j), K = pull(j), middle = now_.u[j] + half;
  const double pulled = K * (problem_.loading.velocity * (now_.time + dt / 2) - (middle - first_u_[j]));
  double force = gain(j, w) / dt - trial_.forcing[j] - pulled, by_p = K * dt / 2;
  if (a2 > 0) {
    const Sinc s = sinc(half);
    const double sine = std::sin(middle), cosine = std::cos(middle);
    force += a2 * sine * s.value;
    by_p += a2 * dt / 2 * (cosine * s.value + sine * s.slope);
  }
  double slope = 1 / (theta * dt) + by_p / (2 * theta);
  if (rubs_) {
    const double f = friction_at(j, w, dt);
    trial_.friction_slope[j] = friction_slope(j, w, f, dt);
    trial_.friction[j] = f;
    force += f;
    slope += trial_.friction_slope[j];
  }
  trial_.force[j] = force;
  trial_.slope[j] = slope;
  trial_.middle[j] = middle;
}

/// The velocity of a site to which Newton's method gives `change`, if friction is not taken as linear in between:
/// w + f(w) / A is what the linear step makes it, with A the slope of all other forces. Friction that is a logarithm of
/// the velocity changes it by many decades at a time, up or down, which no linear step follows.
double ImplicitSteps::velocity_under_friction(std::size_t j, double change, double dt) const {
  const double w = trial_.w[j], f = trial_.friction[j], theta = trial_.theta[j];
  const double by_springs = dt / (2 * theta * springs_.spacing() * springs_.spacing());
  const double weight = 1 / std::fmax(trial_.slope[j] - trial_.friction_slope[j] + by_springs, 1 / (2 * theta * dt));
  std::array<double, most_variables> middle;
  std::copy_n(now_.memory.begin() + static_cast<std::ptrdiff_t>(variables_ * j), variables_, middle.begin());
  const std::span<double> memory(middle.data(), variables_);
  if (variables_ > 0) problem_.friction.law().advance(mean_velocity(j), dt / 2, memory);
  const double linear = w + weight * f + change * (1 + weight * trial_.friction_slope[j]);
  return problem_.friction.velocity_after(linear, weight, memory);
}

/// Changes the velocities by Newton's method. Returns whether all sites have converged: in relative velocity, or in the
/// balance of forces to rounding. An absolute velocity would not do: friction may hold a site at 1e-20 and less, where
/// velocities that differ by all decades below 1e-13 mean forces of any size.
bool ImplicitSteps::correct(double dt) {
  bool converged = true;
  for (std::size_t j = 0; j < n_; ++j) {
    if (springs_.held(j)) continue;
    double& w = trial_.w[j];
    const double change = trial_.right[j], size = std::fabs(change);
    if (!std::isfinite(change)) return false;
    converged = converged && (size <= 1e-6 * std::fabs(w) || size * std::fabs(trial_.slope[j]) <= rounding_);
    const bool curved = rubs_ && size > 0.3 * std::fabs(w) && problem_.friction.steep_at_rest();
    w = curved ? velocity_under_friction(j, change, dt) : w + change;
  }
  return converged;
}

void ImplicitSteps::build_matrix(double dt) {
  const double m = springs_.coupling(), h2 = springs_.spacing() * springs_.spacing();
  const bool ring = springs_.periodic();
  const auto column = [&](std::size_t j, double spread, double bend) {
    return springs_.held(j) ? 0 : spread * trial_.slope[j] - bend * dt / (4 * trial_.theta[j] * h2);
  };
  for_sites([&](std::size_t j) {
    const bool first = j == 0, last = j + 1 == n_;
    if (springs_.held(j)) {
      matrix_.diagonal[j] = 1;
      matrix_.below[j] = matrix_.above[j] = trial_.right[j] = 0;
      return;
    }
    const double left = ring ? 1 : first ? 0 : last ? 2 : 1, right = ring ? 1 : last ? 0 : first ? 2 : 1;
    matrix_.diagonal[j] = column(j, 1 - 2 * m, -2);
    matrix_.below[j] = left == 0 ? 0 : column(first ? n_ - 1 : j - 1, left * m, left);
    matrix_.above[j] = right == 0 ? 0 : column(last ? 0 : j + 1, right * m, right);
    trial_.right[j] = springs_.bend(trial_.middle, j) - springs_.spread(trial_.force, j);
  });
}

/// Whether Newton's method has found the step; then `trial_` is of its last velocities.
bool ImplicitSteps::solve(double dt) {
  prepare(dt);
  for (int iteration = 0; iteration < most_iterations; ++iteration) {
    for_sites([&](std::size_t j) { evaluate(j, dt); });
    build_matrix(dt);
    matrix_.solve(trial_.right, springs_.periodic());
    const bool converged = correct(dt);
    if (!std::all_of(trial_.w.begin(), trial_.w.end(), [](double w) { return std::isfinite(w); }) ||
        !std::isfinite(trial_.right[0]))
      return false;
    if (!converged) continue;
    for_sites([&](std::size_t j) { evaluate(j, dt); });
    return true;
  }
  return false;
}

/// Error of the mean velocity of a step at a site that friction holds. Its velocity follows the force, as the
/// exponential of it under rate-and-state friction: it may rise by many decades in a step that moves nothing until its
/// last part. The logarithm of the velocity is taken as a straight line through the middles of the last two steps.
double ImplicitSteps::creep_error(std::size_t j, double dt) const {
  const double w = trial_.w[j], before = now_.w[j], ratio = w / before;
  if (!rubs_ || !(dt * trial_.friction_slope[j] > 1) || !(ratio > 0)) return 0;
  const double x = std::fmin(std::fabs(std::log(ratio)) * dt / (dt + now_.last_step), 300.0);  // half of it in the step
  const double mean = std::fabs(w) * (x < 1e-3 ? 1 + x * x / 6 : std::sinh(x) / x);
  return std::fabs(mean - std::fabs(w));
}

/// Error of the logarithm of the state variables, if the mean velocity has the error `by_velocity`.
double ImplicitSteps::memory_error(std::size_t j, double dt, double by_velocity) const {
  const double p = std::fabs(mean_velocity(j));
  std::array<double, most_variables> one, other;
  std::copy_n(&now_.memory[variables_ * j], variables_, one.begin());
  other = one;
  const friction::Law& law = problem_.friction.law();
  law.advance(p, dt, std::span(one.data(), variables_));
  double moved = 0, most = 0;
  const auto difference = [](double a, double b) {
    return a > 0 && b > 0 ? std::fabs(std::log(a / b)) : std::fabs(a - b);
  };
  for (std::size_t i = 0; i < variables_; ++i)
    moved = std::fmax(moved, difference(one[i], now_.memory[variables_ * j + i]));
  // The state counts forty times: near the critical stiffness, peak velocities are most sensitive to its errors.
  constexpr double weight = 40;
  const double doubt = by_velocity + std::fabs(next_velocity(j) - now_.v[j]) / 12 * std::fmin(1, moved);
  law.advance(p + doubt, dt, std::span(other.data(), variables_));
  for (std::size_t i = 0; i < variables_; ++i) most = std::fmax(most, difference(one[i], other[i]));
  return weight * most;
}

/// The largest error of the step, in tolerances: that of the trapezoidal rule, dt^3 y''' / 12, by differences of the
/// accelerations of three steps.
double ImplicitSteps::error_of(double dt) const {
  if (!(now_.earlier_step > 0)) return 0.125;  // not known yet: grow carefully
  std::vector<double> errors(n_, 0.0);
  const double h1 = now_.last_step, h2 = now_.earlier_step;
  for_sites([&](std::size_t j) {
    if (springs_.held(j)) return;
    const double now = (next_velocity(j) - now_.v[j]) / dt;
    const double jerk = (now - now_.acceleration[j]) / ((dt + h1) / 2);
    const double before = (now_.acceleration[j] - now_.earlier[j]) / ((h1 + h2) / 2);
    const double snap = (jerk - before) / ((dt + 2 * h1 + h2) / 4);
    const double by_creep = creep_error(j, dt);
    double worst = std::fmax(dt * dt * dt / 12 * std::fmax(std::fabs(jerk), std::fabs(snap)), dt * by_creep);
    if (variables_ > 0) worst = std::fmax(worst, memory_error(j, dt, dt * dt * std::fabs(jerk) / 12 + by_creep));
    errors[j] = std::isfinite(worst) ? worst : HUGE_VAL;
  });
  return *std::max_element(errors.begin(), errors.end()) / problem_.tolerance;
}

void ImplicitSteps::accept(double dt) {
  double work = 0, lost = 0, given = 0;
  const Loading& loading = problem_.loading;
  for (std::size_t j = 0; j < n_; ++j) {
    const bool held = springs_.held(j);
    const double p = held ? 0 : mean_velocity(j), weight = springs_.weight(j), K = pull(j);
    work += weight * dt * trial_.forcing[j] * p;
    if (K > 0)
      work += weight * dt * K * loading.velocity *
              (loading.velocity * (now_.time + dt / 2) - (now_.u[j] + dt * p / 2 - first_u_[j]));
    if (held) continue;
    if (rubs_) lost += weight * dt * trial_.friction[j] * p;
    if (!contacts_.act() || base_.empty()) continue;
    const double middle = now_.u[j] + dt * p / 2, change = aged(j, p, dt).a2 - now_.a2[j];
    const double sine = mean_sine(middle, dt * p / 2);
    lost -= weight * change / 2 * sine * dt * p;  // counted as friction above
    given += weight * change * (1 - std::cos(middle) * std::cos(dt * p / 2));
  }
  now_.supplied += work;
  now_.dissipated += lost;
  now_.by_contacts += given;
  for_sites([&](std::size_t j) {
    if (springs_.held(j)) return;
    const double p = mean_velocity(j), next = next_velocity(j);
    if (contacts_.act()) {
      const Aged then = aged(j, p, dt);
      now_.memory[j] = then.theta;
      now_.excess[j] = then.excess;
      if (!base_.empty()) now_.a2[j] = then.a2;
    } else if (variables_ > 0) {
      problem_.friction.law().advance(p, dt, std::span(&now_.memory[variables_ * j], variables_));
    }
    now_.earlier[j] = now_.acceleration[j];
    now_.acceleration[j] = (next - now_.v[j]) / dt;
    now_.slope[j] = rubs_ ? trial_.friction_slope[j] : 0;
    now_.w[j] = trial_.w[j];
    now_.u[j] += dt * p;
    now_.v[j] = next;
  });
  now_.earlier_step = now_.last_step;
  now_.last_step = dt;
  ++now_.steps;
}

void ImplicitSteps::give_up() const {
  std::size_t site = 0;  // the first without a force, or the fastest
  for (std::size_t j = 0; j < n_ && std::isfinite(trial_.force[site]); ++j)
    if (!(std::fabs(trial_.force[j]) < HUGE_VAL) || std::fabs(trial_.w[j]) > std::fabs(trial_.w[site])) site = j;
  throw NumericsError("t = " + digits(now_.time) + ": no implicit step is short enough; the motion at x = " +
                      digits(problem_.grid.x(site)) + " cannot be followed");
}

/// Ends a run that no longer makes progress: 10,000 implicit steps advanced it by less than one explicit step would.
void ImplicitSteps::check_progress() {
  constexpr long window = 10000;
  if (now_.steps % window != 0) return;
  const double advanced = now_.time - now_.window_start, explicit_step = chosen_step(problem_);
  now_.window_start = now_.time;
  if (advanced > explicit_step) return;
  throw NumericsError("t = " + digits(now_.time) + ": the last " + std::to_string(window) +
                      " implicit steps advanced the chain by " + digits(advanced, 2) + " only; an explicit step is " +
                      digits(explicit_step, 2) + ". Try a larger chain.tolerance, or check for forces that change " +
                      "faster than the chain can move");
}

/// One step, as long as its error allows.
void ImplicitSteps::step() {
  constexpr double shortest = 1e-9;
  double dt = now_.next_step, error = HUGE_VAL;
  while (true) {
    error = solve(dt) ? error_of(dt) : HUGE_VAL;
    if (error <= 1) break;
    if (dt < shortest * std::fmax(1, springs_.spacing())) give_up();
    dt *= std::clamp(0.9 * std::pow(error, -1.0 / 3), 0.2, 0.8);
  }
  now_.next_step = dt * std::clamp(0.9 * std::pow(error, -1.0 / 3), 0.3, 2.0);
  accept(dt);
  now_.time += dt;
  check_progress();
  if (contacts_.act()) check_contacts();
  if (now_.log.active()) look();
}

/// The motion at a time that lies inside a step which has been taken: shorter steps from its start, whose errors are
/// smaller.
void ImplicitSteps::step_to(double time) {
  constexpr double shortest = 1e-12;
  while (now_.time < time) {
    const double remaining = time - now_.time;
    double dt = remaining;
    while (!solve(dt)) {
      dt /= 2;
      if (dt < shortest * remaining) give_up();
    }
    accept(dt);
    now_.time = dt == remaining ? time : now_.time + dt;
  }
  if (contacts_.act()) check_contacts();
  if (now_.log.active()) look();
}

void ImplicitSteps::advance(double until, long most) {
  for (; most > 0 && now_.time < until; --most) {
    if (passed_ && after_.time <= until) {
      std::swap(now_, after_);
      passed_ = false;
      continue;
    }
    if (!passed_) {
      const bool may_pass = now_.time + now_.next_step > until;
      if (may_pass) before_ = now_;
      step();
      if (now_.time <= until) continue;
      std::swap(now_, after_);
      passed_ = true;
    }
    now_ = before_;
    step_to(until);
  }
}

void ImplicitSteps::check_contacts() const {
  for (std::size_t j = 0; j < n_; ++j)
    if (!(effective_stress(j) > 0))
      throw NumericsError("t = " + digits(now_.time) + ": at x = " + digits(problem_.grid.x(j)) +
                          " the pore pressure has reached the normal stress: the effective normal stress is " +
                          digits(effective_stress(j)) + " of it");
}

}  // namespace slipfront::chain
