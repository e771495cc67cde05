#include "implicit.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <exception>
#include <limits>
#include <span>

#include "../digits.hpp"
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
  const double theta = memory_[j], excess = excess_[j];
  double middle = theta, end = theta;
  problem_.friction.law().advance(p, dt / 2, {&middle, 1});
  problem_.friction.law().advance(p, dt, {&end, 1});
  const double after = contacts_.excess_after(dt, excess, theta, end);
  return {end, after, base_.empty() ? 0 : base_[j] * contacts_.strength(end, after),
          contacts_.share(contacts_.excess_after(dt / 2, excess, theta, middle))};
}

/// At the memory of the middle of the step, which the mean velocity has aged; and what the substrate has more than at
/// the start of the step, where contacts change.
double ImplicitSteps::friction_at(std::size_t j, double w, double dt) const {
  if (variables_ == 0) return problem_.friction.force(w);
  std::array<double, most_variables> middle;
  std::copy_n(&memory_[variables_ * j], variables_, middle.begin());
  const std::span<double> memory(middle.data(), variables_);
  const double p = v_[j] + gain(j, w) / 2;
  problem_.friction.law().advance(p, dt / 2, memory);
  const double force = problem_.friction.force(w, memory);
  if (!contacts_.act()) return force;
  const Aged then = aged(j, p, dt);
  const double more = (then.a2 - contact_squared(j)) / 2;
  return then.share * force + (more == 0 ? 0 : more * mean_sine(u_[j] + dt * p / 2, dt * p / 2));
}

/// Guesses velocities, and chooses the velocity that friction feels.
void ImplicitSteps::prepare(double dt) {
  const double middle = time_ + dt / 2;
  for (std::size_t j = 0; j < n_; ++j)  // formulas are called from one thread
    trial_.forcing[j] = problem_.forcing ? problem_.forcing(problem_.grid.x(j), middle) : 0;
  double largest = 0;
  for (const double u : u_) largest = std::fmax(largest, std::fabs(u));
  rounding_ = 1e-13 + 4 * std::numeric_limits<double>::epsilon() * largest / (springs_.spacing() * springs_.spacing());
  for_sites([&](std::size_t j) {
    const double z = dt * std::fmax(slope_[j], 0.0), eta = steps_ == 0 ? 0 : z / (3 * (1 + z));
    trial_.theta[j] = (1 + eta) / 2;
    trial_.shift[j] = eta / 2 * dt * acceleration_[j];
    trial_.w[j] = springs_.held(j) ? 0 : v_[j] + dt / 2 * acceleration_[j];
  });
}

/// The slope of friction at w, where it is f: at first that of the last step, then that between the last two guesses,
/// and by a small difference where this does not lead to the end.
double ImplicitSteps::friction_slope(std::size_t j, double w, double f, double dt, int iteration) const {
  constexpr int patience = 8;
  if (iteration == 0) return slope_[j];
  if (iteration < patience) {
    const double gone = w - trial_.last_w[j];
    return std::fabs(gone) > 1e-6 * std::fabs(w) ? (f - trial_.friction[j]) / gone : trial_.friction_slope[j];
  }
  const double step = std::copysign(std::fmax(1e-6 * std::fabs(w), 1e-30), w);
  return (friction_at(j, w + step, dt) - f) / step;
}

/// The force on a site that is not of the springs between sites, (v' - v) / dt + S + f - F, and its slope in w.
void ImplicitSteps::evaluate(std::size_t j, double dt, int iteration) {
  if (springs_.held(j)) {
    trial_.force[j] = springs_.held_force(j);
    trial_.slope[j] = 1;
    return;
  }
  const double theta = trial_.theta[j], w = trial_.w[j], p = mean_velocity(j), half = dt * p / 2;
  const double a2 = contact_squared(j), K = pull(j), middle = u_[j] + half;
  const double pulled = K * (problem_.loading.velocity * (time_ + dt / 2) - (middle - first_u_[j]));
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
    trial_.friction_slope[j] = friction_slope(j, w, f, dt, iteration);
    trial_.friction[j] = f;
    trial_.last_w[j] = w;
    force += f;
    slope += trial_.friction_slope[j];
  }
  trial_.force[j] = force;
  trial_.slope[j] = slope;
}

/// Newton's method for w. Where friction is a logarithm, a velocity that would fall by more than half falls by the same
/// exponent instead: that is Newton's step for the logarithm. Returns whether all sites have arrived.
bool ImplicitSteps::correct() {
  std::vector<double>& change = trial_.right;
  bool arrived = true;
  for (std::size_t j = 0; j < n_; ++j) {
    if (springs_.held(j)) continue;
    double& w = trial_.w[j];
    double d = change[j];
    if (!std::isfinite(d)) {
      trial_.w[0] = d;
      return false;
    }
    const double size = std::fabs(w);
    const bool falls = d * w < 0 && std::fabs(d) > size / 2;
    const bool logarithm = rubs_ && std::fabs(w * trial_.friction_slope[j]) < 0.8 * std::fabs(trial_.friction[j]) &&
                           trial_.friction_slope[j] > 0.5 * trial_.slope[j];
    if (falls && logarithm) {
      w *= std::exp(std::fmax(d / w, -20.0));
      arrived = false;
      continue;
    }
    w += d;
    const double d_size = std::fabs(d);
    arrived = arrived && (d_size <= 1e-6 * size || d_size <= 1e-13 || d_size * std::fabs(trial_.slope[j]) <= rounding_);
  }
  return arrived;
}

/// Whether Newton's method has found the step; then `trial_` is of its last velocities.
bool ImplicitSteps::solve(double dt) {
  prepare(dt);
  const double m = springs_.coupling(), h2 = springs_.spacing() * springs_.spacing();
  std::vector<double> middle(n_);
  for (int iteration = 0; iteration < most_iterations; ++iteration) {
    for_sites([&](std::size_t j) {
      evaluate(j, dt, iteration);
      middle[j] = springs_.held(j) ? u_[j] : u_[j] + dt / 2 * mean_velocity(j);
    });
    const auto column = [&](std::size_t j, double spread, double bend) {
      return springs_.held(j) ? 0 : spread * trial_.slope[j] - bend * dt / (4 * trial_.theta[j] * h2);
    };
    const bool ring = springs_.periodic();
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
      trial_.right[j] = springs_.bend(middle, j) - springs_.spread(trial_.force, j);
    });
    matrix_.solve(trial_.right, ring);
    if (correct()) {
      for_sites([&](std::size_t j) { evaluate(j, dt, iteration + 1); });
      return true;
    }
    if (!std::isfinite(trial_.w[0])) return false;
  }
  return false;
}

/// How much what a place remembers would change if the velocity were another by as much as it may be wrong.
double ImplicitSteps::memory_error(std::size_t j, double dt, double jerk) const {
  const double p = std::fabs(mean_velocity(j));
  std::array<double, most_variables> one, other;
  std::copy_n(&memory_[variables_ * j], variables_, one.begin());
  other = one;
  const friction::Law& law = problem_.friction.law();
  law.advance(p, dt, std::span(one.data(), variables_));
  double moved = 0, most = 0;
  const auto difference = [](double a, double b) {
    return a > 0 && b > 0 ? std::fabs(std::log(a / b)) : std::fabs(a - b);
  };
  for (std::size_t i = 0; i < variables_; ++i)
    moved = std::fmax(moved, difference(one[i], memory_[variables_ * j + i]));
  const double doubt = dt * dt * std::fabs(jerk) / 12 + std::fabs(next_velocity(j) - v_[j]) / 12 * std::fmin(1, moved);
  law.advance(p + doubt, dt, std::span(other.data(), variables_));
  for (std::size_t i = 0; i < variables_; ++i) most = std::fmax(most, difference(one[i], other[i]));
  return most;
}

/// The largest error of the step, in tolerances: that of the trapezoidal rule, dt^3 y''' / 12, by differences of the
/// accelerations of three steps.
double ImplicitSteps::error_of(double dt) const {
  if (!(earlier_step_ > 0)) return 0.125;  // not known yet: grow carefully
  std::vector<double> errors(n_, 0.0);
  const double h1 = last_step_, h2 = earlier_step_;
  for_sites([&](std::size_t j) {
    if (springs_.held(j)) return;
    const double now = (next_velocity(j) - v_[j]) / dt;
    const double jerk = (now - acceleration_[j]) / ((dt + h1) / 2);
    const double before = (acceleration_[j] - earlier_[j]) / ((h1 + h2) / 2);
    const double snap = (jerk - before) / ((dt + 2 * h1 + h2) / 4);
    double worst = dt * dt * dt / 12 * std::fmax(std::fabs(jerk), std::fabs(snap));
    if (variables_ > 0) worst = std::fmax(worst, memory_error(j, dt, jerk));
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
              (loading.velocity * (time_ + dt / 2) - (u_[j] + dt * p / 2 - first_u_[j]));
    if (held) continue;
    if (rubs_) lost += weight * dt * trial_.friction[j] * p;
    if (!contacts_.act() || base_.empty()) continue;
    const double middle = u_[j] + dt * p / 2, change = aged(j, p, dt).a2 - a2_[j];
    const double sine = mean_sine(middle, dt * p / 2);
    lost -= weight * change / 2 * sine * dt * p;  // counted as friction above
    given += weight * change * (1 - std::cos(middle) * std::cos(dt * p / 2));
  }
  supplied_ += work;
  dissipated_ += lost;
  by_contacts_ += given;
  for_sites([&](std::size_t j) {
    if (springs_.held(j)) return;
    const double p = mean_velocity(j), next = next_velocity(j);
    if (contacts_.act()) {
      const Aged then = aged(j, p, dt);
      memory_[j] = then.theta;
      excess_[j] = then.excess;
      if (!base_.empty()) a2_[j] = then.a2;
    } else if (variables_ > 0) {
      problem_.friction.law().advance(p, dt, std::span(&memory_[variables_ * j], variables_));
    }
    earlier_[j] = acceleration_[j];
    acceleration_[j] = (next - v_[j]) / dt;
    slope_[j] = rubs_ ? trial_.friction_slope[j] : 0;
    u_[j] += dt * p;
    v_[j] = next;
    trial_.w[j] = p;  // for look()
  });
  earlier_step_ = last_step_;
  last_step_ = dt;
  ++steps_;
}

void ImplicitSteps::advance(double until, long most) {
  constexpr double shortest = 1e-9;
  while (most-- > 0 && time_ < until) {
    // The last two steps before `until` are alike: none is short.
    const double remaining = until - time_;
    double dt = next_step_ >= remaining ? remaining : next_step_ > remaining / 2 ? remaining / 2 : next_step_;
    double error = HUGE_VAL;
    while (true) {
      error = solve(dt) ? error_of(dt) : HUGE_VAL;
      if (error <= 1) break;
      if (dt < shortest * std::fmax(1, springs_.spacing())) {
        std::size_t site = 0;  // the first without a force, or the fastest
        for (std::size_t j = 0; j < n_ && std::isfinite(trial_.force[site]); ++j)
          if (!(std::fabs(trial_.force[j]) < HUGE_VAL) || std::fabs(trial_.w[j]) > std::fabs(trial_.w[site])) site = j;
        throw NumericsError("t = " + digits(time_) + ": no implicit step is short enough; the motion at x = " +
                            digits(problem_.grid.x(site)) + " cannot be followed");
      }
      dt *= std::clamp(0.9 * std::pow(error, -1.0 / 3), 0.2, 0.8);
    }
    accept(dt);
    const bool last = dt >= remaining;
    time_ = last ? until : time_ + dt;
    const double grown = dt * std::clamp(0.9 * std::pow(error, -1.0 / 3), 0.3, 2.0);
    next_step_ = dt < next_step_ ? std::fmax(grown, std::fmin(next_step_, 2 * grown)) : grown;
    if (contacts_.act()) check_contacts();
    if (log_.active()) look();
  }
}

void ImplicitSteps::check_contacts() const {
  for (std::size_t j = 0; j < n_; ++j)
    if (!(effective_stress(j) > 0))
      throw NumericsError("t = " + digits(time_) + ": at x = " + digits(problem_.grid.x(j)) +
                          " the pore pressure has reached the normal stress: the effective normal stress is " +
                          digits(effective_stress(j)) + " of it");
}

}  // namespace slipfront::chain
