// Rate-and-state friction with its average over a train. Each place has a state theta, the age of its contacts.

#include <algorithm>
#include <cmath>
#include <vector>

#include "foundation/simd/elementary.hpp"
#include "friction/rate_and_state_loops.hpp"
#include "slipfront/friction/friction.hpp"

namespace slipfront::friction {
namespace {

/// Weights of the mean over slip in y, pi / 2 - u / 2 = gd(y), as in law.cpp, for a smooth integrand to 1e-11.
struct Nodes {
  static constexpr std::size_t size = 90;
  double sech[size], tanh[size], weight[size];
  Nodes() {
    double sum = 0;
    for (std::size_t i = 0; i < size; ++i) {
      const double y = 0.32 * static_cast<double>(i);
      sech[i] = 1 / std::cosh(y);
      tanh[i] = std::tanh(y);
      weight[i] = i == 0 ? 0.5 : sech[i];
      sum += weight[i];
    }
    for (double& w : weight) w /= sum;
  }
};

/// Mean over slip of asinh(A r), r = (sech^2 y + s^2 tanh^2 y)^(1/2) the slip velocity over the fastest, from ln A.
double mean_of_asinh(double log_A, double s) {
  static const Nodes nodes;
  constexpr double log_two = 0.69314718055994531, large = 18;  // beyond it asinh(e^x) is x + ln 2
  double sum = 0;
  if (log_A < 300) {
    const double A = std::exp(log_A);
    for (std::size_t i = 0; i < Nodes::size; ++i) {
      const double t = s * nodes.tanh[i], x = A * std::sqrt(nodes.sech[i] * nodes.sech[i] + t * t);
      sum += nodes.weight[i] * (x < 1e-4 ? x * (1 - x * x / 6) : std::log(x + std::sqrt(1 + x * x)));
    }
    return sum;
  }
  for (std::size_t i = 0; i < Nodes::size; ++i) {
    const double log_x = log_A + std::log(std::hypot(nodes.sech[i], s * nodes.tanh[i]));
    sum += nodes.weight[i] * (log_x > large ? log_x + log_two : std::asinh(std::exp(log_x)));
  }
  return sum;
}

enum Value : std::size_t { f0, direct, evolution, distance, velocity, age, state_law, values_in_all };

class RateAndState final : public Law {
 public:
  explicit RateAndState(const std::vector<double>& v)
      : f0_(v[f0]),
        a_(v[direct]),
        b_(v[evolution]),
        D_(v[distance]),
        v0_(v[velocity]),
        age_(v[age] > 0 ? v[age] : D_ / v0_),
        slip_law_(v[state_law] != 0),
        rule_{a_, (f0_ + b_ * std::log(v0_ / D_)) / a_ - std::log(2 * v0_), b_ / a_, D_} {}

  /// a asinh((w / 2 w_0) exp(E)), E = (f_0 + b ln(theta w_0 / D_c)) / a, without overflow.
  double strength(double speed, Memory theta) const override {
    if (!(speed > 0)) return 0;
    const double log_twice = std::log(speed / v0_) + exponent(theta);  // of 2 x, with f = a asinh x
    return a_ * (log_twice > large ? log_twice : std::asinh(std::exp(log_twice) / 2));
  }
  bool steep_at_rest() const override { return true; }

  /// v + weight f(v) = free. In s = f / a it is convex with its root below the start, so that Newton's steps fall to
  /// it.
  double speed_after(double free, double weight, Memory theta) const override {
    if (!(free > 0)) return 0;
    const double E = exponent(theta);
    const auto speed = [&](double s) {
      return 2 * v0_ * (s > large ? std::exp(s - E) / 2 : std::sinh(s) * std::exp(-E));
    };
    double s = std::fmin(strength(free, theta) / a_, free / (weight * a_));
    for (int i = 0; i < 60; ++i) {
      const double v = speed(s), slope = s > large ? v : 2 * v0_ * std::cosh(s) * std::exp(-E);
      const double step = (v + weight * a_ * s - free) / (slope + weight * a_);
      s -= step;
      if (std::fabs(step) <= 1e-9 * s) break;  // what is left is of the order of its square
    }
    // The difference free - weight f has the digits where friction is weak, the speed itself where it is strong.
    const double left = free - weight * a_ * s;
    return left > free / 2 ? left : speed(s);
  }

  /// Over slip, <ln w> = ln(a sinh |phi|) + psi: (1 / 2 pi) int ln(cosh 2 psi - cos u) du = 2 psi - ln 2. So the
  /// average of the law is the law itself at the speed a sinh |phi| e^psi, except where f is no logarithm, near rest.
  double mean_strength(const State& state, double contact, Closure closure, Memory theta) const override {
    if (state.phi == 0 || state.empty()) return 0;
    if (closure != Closure::consistent) return Law::mean_strength(state, contact, closure, theta);
    const double log_sinh = std::log(contact * std::sinh(std::fabs(state.phi)) / v0_) + exponent(theta);
    if (log_sinh + std::log(2 * std::sinh(state.psi)) > large) return a_ * (log_sinh + state.psi);
    return a_ * mean_of_asinh(log_sinh + std::log(std::cosh(state.psi)), std::tanh(state.psi));
  }

  void strengths(std::size_t size, const double* speed, Memories theta, double* force) const override {
    if (forces(rule_, size, speed, theta.values, force)) return;
    for (std::size_t i = 0; i < size; ++i)
      if (!within_exponents(rule_, theta.values[i])) force[i] = strength(speed[i], theta.of(i));
  }
  void speeds_after(std::size_t size, const double* free, double weight, Memories theta, double* speed) const override {
    constexpr std::size_t most = 64;
    double done[most];
    for (std::size_t begin = 0; begin < size; begin += most) {
      const std::size_t n = std::min(most, size - begin);
      if (friction::speeds_after(rule_, n, free + begin, weight, theta.values + begin, speed + begin, done)) continue;
      for (std::size_t i = 0; i < n; ++i)
        if (done[i] == 0) speed[begin + i] = speed_after(free[begin + i], weight, theta.of(begin + i));
    }
  }
  void mean_strengths(const Trains& trains, Closure closure, double* mean, double* slope) const override {
    if (closure == Closure::consistent)
      mean_forces(rule_, trains.size, trains.fastest, trains.s, trains.memory.values, mean, slope);
    else
      Law::mean_strengths(trains, closure, mean, slope);
  }

  /// Under a share s, v = s v' obeys v' + weight a asinh(G s v') = free / s, and b ln(theta) has s G as well: theta
  /// s^(a / b) in place of theta.
  void speeds_after_under(std::size_t size, const double* share, const double* free, double weight, Memories theta,
                          double* speed) const override {
    constexpr std::size_t most = 64;
    constexpr double most_power = 20;
    if (!(a_ < most_power * b_)) return Law::speeds_after_under(size, share, free, weight, theta, speed);
    double freed[most], aged[most];
    for (std::size_t begin = 0; begin < size; begin += most) {
      const std::size_t n = std::min(most, size - begin);
      for (std::size_t i = 0; i < n; ++i) {
        freed[i] = free[begin + i] / share[begin + i];
        aged[i] = theta.values[begin + i] * exp_branch_free(a_ / b_ * log_branch_free(share[begin + i]));
      }
      speeds_after(n, freed, weight, {aged, 1}, speed + begin);
      for (std::size_t i = 0; i < n; ++i) speed[begin + i] *= share[begin + i];
    }
  }

  void start(std::span<double> theta) const override { theta[0] = age_; }

  /// Exact at a constant velocity. Ageing: theta_t = 1 - |w| theta / D_c. Slip: theta_t = -x ln x, x = |w| theta / D_c.
  void advance(double velocity, double time, std::span<double> theta) const override {
    const double speed = std::fabs(velocity);
    if (slip_law_)
      evolve_by_slip(speed, speed, time, theta);
    else
      evolve_by_ageing(speed, time, theta);
  }
  /// The ageing law is linear in w. Of the slip law the mean over time is -(W theta / D_c) (<ln w>_u + ln(theta /
  /// D_c)), as W dt is du.
  void advance_in_train(double mean, double typical, double time, std::span<double> theta) const override {
    if (slip_law_)
      evolve_by_slip(std::fabs(mean), typical, time, theta);
    else
      evolve_by_ageing(std::fabs(mean), time, theta);
  }
  void advance_all(std::size_t size, const double* velocity, double time, std::size_t, double* theta) const override {
    advance_in_trains(size, velocity, velocity, time, 1, theta);
  }
  void advance_in_trains(std::size_t size, const double* mean, const double* typical, double time, std::size_t,
                         double* theta) const override {
    if (slip_law_)
      advance_by_slip(rule_, size, mean, typical, time, theta);
    else
      advance_ageing(rule_, size, mean, time, theta);
  }

 private:
  static constexpr double large = 18;  // beyond it asinh(e^x / 2) is x to 1e-16

  void evolve_by_slip(double speed, double typical, double time, std::span<double> theta) const {
    if (speed > 0 && typical > 0)
      theta[0] *= std::exp(std::log(typical * theta[0] / D_) * std::expm1(-speed * time / D_));
  }
  void evolve_by_ageing(double speed, double time, std::span<double> theta) const {
    const double passed = speed * time / D_;
    const double gained = passed > 1e-12 ? -std::expm1(-passed) / passed : 1 - passed / 2;
    theta[0] = theta[0] * std::exp(-passed) + time * gained;
  }

  double exponent(Memory theta) const { return (f0_ + b_ * std::log(theta[0] * v0_ / D_)) / a_; }

  double f0_, a_, b_, D_, v0_, age_;
  bool slip_law_;
  RateAndStateRule rule_;
};

}  // namespace

const Definition& rate_and_state_law() {
  static const auto force = [](std::string_view name, std::string_view symbol, double value) {
    return Parameter{.name = name, .symbol = symbol, .unit = force_unit, .value = value, .dimension = Dimension::force};
  };
  static const Definition definition{
      .name = "rate-and-state",
      .adjective = "rate-and-state",
      .equation =
          "f = a asinh((w / 2 w_0) exp((f_0 + b ln(theta w_0 / D_c)) / a)), with the sign of w; ageing: theta_t = 1 - "
          "|w| theta / D_c; slip: theta_t = -x ln x with x = |w| theta / D_c",
      .source =
          "Dieterich (1979), J. Geophys. Res. 84:2161; Ruina (1983), J. Geophys. Res. 88:10359; regularised as by "
          "Rice & Ben-Zion (1996), Proc. Natl. Acad. Sci. 93:3811",
      .parameters = {strength_in(force_unit, "f_0"),
                     [] {
                       Parameter a = force("direct_effect", "a", 0.01);
                       a.without_least = true;
                       return a;
                     }(),
                     force("evolution_effect", "b", 0),
                     {.name = "characteristic_slip",
                      .symbol = "D_c",
                      .unit = "b / (2 pi)",
                      .value = 1,
                      .without_least = true,
                      .dimension = Dimension::slip},
                     {.name = "reference_velocity",
                      .symbol = "w_0",
                      .unit = "c A / pi",
                      .value = 1,
                      .without_least = true,
                      .dimension = Dimension::velocity},
                     {.name = "initial_state", .symbol = "theta_0", .unit = "b / (c A)", .dimension = Dimension::time},
                     {.name = "state", .symbol = "", .unit = "1", .most = 1, .words = {"ageing", "slip"}},
                     {.name = "contact_ageing", .symbol = "beta", .unit = "1", .on_chain_alone = true},
                     {.name = "contact_time",
                      .symbol = "theta_c",
                      .unit = "b / (c A)",
                      .dimension = Dimension::time,
                      .on_chain_alone = true},
                     {.name = "dilatancy",
                      .symbol = "epsilon / b_p",
                      .unit = "normal stress",
                      .dimension = Dimension::pressure,
                      .on_chain_alone = true},
                     {.name = "drainage_time",
                      .symbol = "t_p",
                      .unit = "b / (c A)",
                      .dimension = Dimension::time,
                      .on_chain_alone = true},
                     {.name = "pore_pressure",
                      .symbol = "p_0",
                      .unit = "normal stress",
                      .most = 1,
                      .dimension = Dimension::pressure,
                      .on_chain_alone = true}},
      .variables = {{.name = "theta", .symbol = "theta", .unit = "b / (c A)"}},
      .make = [](const std::vector<double>& values, const Curve&) -> std::shared_ptr<const Law> {
        return std::make_shared<RateAndState>(values);
      }};
  return definition;
}

}  // namespace slipfront::friction
