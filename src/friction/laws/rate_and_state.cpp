// Rate-and-state friction. Each position has a state variable theta, the age of its contacts.

#include <algorithm>
#include <cmath>
#include <vector>

#include "friction/laws/force_of_speed.hpp"
#include "friction/laws/rate_and_state_loops.hpp"
#include "friction/state/contacts.hpp"
#include "friction/train_means/asinh_average.hpp"
#include "math/simd/elementary.hpp"
#include "math/simd/vector_code.hpp"

namespace slipfront::friction {
namespace {

enum Value : std::size_t { f0, direct, evolution_effect, distance, velocity, age, kind };

class RateAndStateLoops final : public ForceLoops {
 public:
  RateAndStateLoops(const Law& law, const AsinhForce& force, double direct_over_evolution)
      : ForceLoops(law), force_(force), a_over_b_(direct_over_evolution) {}

  void strengths(std::size_t size, const double* speed, LocalStates states, double* force) const override {
    double copies[part_size];
    in_parts(size, [&](std::size_t begin, std::size_t some) {
      const double* const theta = states.from(begin).column(0, some, copies);
      if (forces(force_, some, speed + begin, theta, force + begin)) return;
      for (std::size_t i = 0; i < some; ++i)
        if (!within_exponents(force_, theta[i])) force[begin + i] = law_.strength(speed[begin + i], {theta + i, 1});
    });
  }

  void speeds_after(std::size_t size, const double* free, double weight, LocalStates states,
                    double* speed) const override {
    double copies[part_size], done[part_size];
    in_parts(size, [&](std::size_t begin, std::size_t some) {
      const double* const theta = states.from(begin).column(0, some, copies);
      if (friction::speeds_after(force_, some, free + begin, weight, theta, speed + begin, done)) return;
      for (std::size_t i = 0; i < some; ++i)
        if (done[i] == 0) speed[begin + i] = law_.speed_after(free[begin + i], weight, {theta + i, 1});
    });
  }

  /// If the normal stress is a share s, the speed v = s v' obeys v' + weight a asinh(s G v') = free / s. Because G is
  /// proportional to theta^(b / a), the factor s has the same effect as theta s^(a / b) in place of theta.
  void speeds_after_under(std::size_t size, const double* share, const double* free, double weight, LocalStates states,
                          double* speed) const override {
    constexpr double most_power = 20;
    if (!(a_over_b_ < most_power)) return ForceLoops::speeds_after_under(size, share, free, weight, states, speed);
    double freed[part_size], aged[part_size];
    in_parts(size, [&](std::size_t begin, std::size_t some) {
      for (std::size_t i = 0; i < some; ++i) {
        freed[i] = free[begin + i] / share[begin + i];
        aged[i] = states(begin + i, 0) * exp_branch_free(a_over_b_ * log_branch_free(share[begin + i]));
      }
      speeds_after(some, freed, weight, {aged, 1}, speed + begin);
      for (std::size_t i = 0; i < some; ++i) speed[begin + i] *= share[begin + i];
    });
  }

 private:
  AsinhForce force_;
  double a_over_b_;
};

class VaryingRateAndState;

class RateAndState final : public Law {
 public:
  using WhereItVaries = VaryingRateAndState;

  explicit RateAndState(const std::vector<double>& v)
      : Law({.steep_at_rest = true}),
        f0_(v[f0]),
        a_(v[direct]),
        b_(v[evolution_effect]),
        D_(v[distance]),
        v0_(v[velocity]),
        loops_(*this, asinh_force(), a_ / b_),
        average_(*this, asinh_force()),
        evolution_(v[kind] != 0 ? ContactAge::Kind::slip : ContactAge::Kind::ageing, v[age] > 0 ? v[age] : D_ / v0_,
                   D_) {}

  /// Computes a asinh((w / 2 w_0) exp(E)), E = (f_0 + b ln(theta w_0 / D_c)) / a, without overflow.
  double strength(double speed, LocalState theta) const override {
    if (!(speed > 0)) return 0;
    const double log_twice = std::log(speed / v0_) + exponent(theta);  // ln(2 x), where f = a asinh x
    return a_ * (log_twice > large ? log_twice : std::asinh(std::exp(log_twice) / 2));
  }

  /// Solves v + weight f(v) = free by Newton's method in s = f / a. The equation is convex in s and the start is above
  /// its root, so the steps descend to the root.
  double speed_after(double free, double weight, LocalState theta) const override {
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
      if (std::fabs(step) <= 1e-9 * s) break;  // the remaining error is of the order of step^2
    }
    // The difference free - weight f is more precise if friction is weak, and the speed at s if friction is strong.
    const double slowed = free - weight * a_ * s;
    return slowed > free / 2 ? slowed : speed(s);
  }

  const ForceLoops& loops() const override { return loops_; }
  const TrainAverage& average() const override { return average_; }
  const StateEvolution& evolution() const override { return evolution_; }

 private:
  static constexpr double large = 18;  // above it, asinh(e^x / 2) = x to 1e-16

  double exponent(LocalState theta) const { return (f0_ + b_ * std::log(theta[0] * v0_ / D_)) / a_; }
  AsinhForce asinh_force() const {
    return {.a = a_, .base = (f0_ + b_ * std::log(v0_ / D_)) / a_ - std::log(2 * v0_), .share = b_ / a_};
  }

  double f0_, a_, b_, D_, v0_;
  RateAndStateLoops loops_;
  AsinhAverage average_;
  ContactAge evolution_;
};

/// Parameters and states of the positions of a part.
struct AtPositions {
  ParametersOfPart<age> parameters;  ///< those before the age
  const double* theta = nullptr;
  double exponent[part_size], G[part_size];  ///< f = a asinh(w G), G = exp(exponent) / 2 w_0
  double copies[part_size];                  ///< theta, if it is not next to each other already

  AtPositions(const std::vector<double>& values, const Varying& varying) : parameters(values, varying) {}
  const double* of(Value parameter) const { return parameters.at()[parameter]; }
};

constexpr double largest_exponent = 600;

SLIPFRONT_CLONES void find_G(std::size_t size, AtPositions& at) {
  const double *const f_0 = at.of(f0), *const a = at.of(direct), *const b = at.of(evolution_effect);
  const double *const D = at.of(distance), *const w_0 = at.of(velocity), *const theta = at.theta;
  double *const exponent = at.exponent, *const G = at.G;
  SLIPFRONT_INDEPENDENT
  for (std::size_t i = 0; i < size; ++i) {
    const double aged = log_branch_free(at_least(theta[i] * w_0[i] / D[i], AsinhForce::least_theta));
    const double E = (f_0[i] + b[i] * aged) / a[i];
    exponent[i] = E;
    G[i] = exp_branch_free(at_most(at_least(E, -largest_exponent), largest_exponent)) / (2 * w_0[i]);
  }
}

/// The law with parameters that vary. Its force at a position is a times that of one law asinh(w theta') at theta' = G.
/// Vector code of that law then serves them, and the evolution of theta at the speed w / D_c.
class VaryingRateAndState final : public VaryingLaw<RateAndState> {
 public:
  VaryingRateAndState(const std::vector<double>& values, const Varying& varying) : VaryingLaw(values, varying) {}
  const ForceLoops& loops() const override { return loops_; }
  const TrainAverage& average() const override { return average_; }
  const StateEvolution& evolution() const override { return evolution_; }

 private:
  static constexpr AsinhForce one{.a = 1, .base = 0, .share = 1};

  /// Calls `task` with the first position of each part, its size, and the values there.
  template <class Task>
  void with_values(std::size_t size, LocalStates states, const Task& task) const {
    AtPositions at(values(), varying());
    in_parts(size, [&](std::size_t begin, std::size_t some) {
      const LocalStates part = states.from(begin);
      at.parameters.take(part, some);
      at.theta = part.column(0, some, at.copies);
      task(begin, some, at);
    });
  }

  class Loops final : public ForceLoops {
   public:
    explicit Loops(const VaryingRateAndState& law) : ForceLoops(law), all_(law) {}
    void strengths(std::size_t size, const double* speed, LocalStates states, double* force) const override {
      all_.with_values(size, states, [&](std::size_t begin, std::size_t some, AtPositions& at) {
        find_G(some, at);
        const bool within = forces(one, some, speed + begin, at.G, force + begin);
        multiply(some, at.of(direct), force + begin);
        for (std::size_t i = 0; i < some && !within; ++i)
          if (!within_exponents(one, at.G[i])) force[begin + i] = law_.strength(speed[begin + i], states.at(begin + i));
      });
    }
    /// v = a v' with v' + weight asinh(a G v') = free / a.
    void speeds_after(std::size_t size, const double* free, double weight, LocalStates states,
                      double* speed) const override {
      all_.with_values(size, states, [&](std::size_t begin, std::size_t some, AtPositions& at) {
        double freed[part_size], done[part_size];
        find_G(some, at);
        divide(some, free + begin, at.of(direct), freed);
        multiply(some, at.of(direct), at.G);
        const bool all = friction::speeds_after(one, some, freed, weight, at.G, speed + begin, done);
        multiply(some, at.of(direct), speed + begin);
        for (std::size_t i = 0; i < some && !all; ++i)
          if (done[i] == 0) speed[begin + i] = law_.speed_after(free[begin + i], weight, states.at(begin + i));
      });
    }

   private:
    const VaryingRateAndState& all_;
  };

  class Average final : public VaryingLaw::Average {
   public:
    explicit Average(const VaryingRateAndState& law) : VaryingLaw::Average(law), all_(law), mean_of_one_(law, one) {}
    void mean_strengths(const Trains& trains, Closure closure, double* mean, double* slope) const override {
      if (closure != Closure::consistent) return QuadratureAverage::mean_strengths(trains, closure, mean, slope);
      all_.with_values(trains.size, trains.states, [&](std::size_t begin, std::size_t some, AtPositions& at) {
        const auto find = [&](const TrainAverage& average, std::size_t i, std::size_t count, const double* theta) {
          const std::size_t first = begin + i;
          average.mean_strengths({count, trains.fastest + first, trains.s + first, {theta, 1}}, closure, mean + first,
                                 slope == nullptr ? nullptr : slope + first);
        };
        find_G(some, at);
        find(mean_of_one_, 0, some, at.G);
        for (std::size_t i = 0; i < some; ++i) {
          mean[begin + i] *= at.of(direct)[i];
          if (slope != nullptr) slope[begin + i] *= at.of(direct)[i];
          if (!(std::fabs(at.exponent[i]) < largest_exponent))
            find(all_.law_at(trains.states.at(begin + i)).average(), i, 1, &at.theta[i]);
        }
      });
    }

   private:
    const VaryingRateAndState& all_;
    AsinhAverage mean_of_one_;
  };

  class Evolution final : public VaryingLaw::Evolution {
   public:
    explicit Evolution(const VaryingRateAndState& law)
        : VaryingLaw::Evolution(law),
          all_(law),
          of_one_(law.values()[kind] != 0 ? ContactAge::Kind::slip : ContactAge::Kind::ageing, 0, 1) {}
    void advance_all(std::size_t size, const Slips& slips, double time, EvolvingStates states) const override {
      all_.with_values(size, states, [&](std::size_t begin, std::size_t some, AtPositions& at) {
        double mean[part_size], typical[part_size];
        divide(some, slips.mean + begin, at.of(distance), mean);
        const bool same = slips.typical == slips.mean;
        if (!same) divide(some, slips.typical + begin, at.of(distance), typical);
        of_one_.advance_all(some, {mean, same ? mean : typical}, time, states.from(begin));
      });
    }

   private:
    const VaryingRateAndState& all_;
    ContactAge of_one_;
  };

  Loops loops_{*this};
  Average average_{*this};
  Evolution evolution_{*this};
};

template <typename T>
Parameter with(Parameter parameter, T Parameter::*member, T value) {
  parameter.*member = value;
  return parameter;
}

std::vector<Parameter> parameters_of_friction() {
  return {strength_in(force_unit, "f_0", "friction at the reference velocity in steady slip"),
          with(force_named("direct_effect", "a", "growth of friction with ln w at a constant state", 0.01),
               &Parameter::without_least, true),
          force_named("evolution_effect", "b", "growth of friction with ln theta"),
          characteristic_slip(),
          velocity_named("reference_velocity", "w_0", "slip velocity at which steady friction is f_0"),
          {.name = "initial_state",
           .symbol = "theta_0",
           .unit = "b / (c A)",
           .meaning = "age theta of the contacts at t = 0; 0 means D_c / w_0",
           .dimension = Dimension::time},
          {.name = "state",
           .symbol = "",
           .unit = "1",
           .meaning = "law by which the age of the contacts evolves",
           .most = 1,
           .words = {"ageing", "slip"}}};
}

/// Parameters of contacts that age and of pores that dilate, which only a chain has.
std::vector<Parameter> parameters_of_contacts() {
  static const auto on_chain = [](std::string_view name, std::string_view symbol, std::string_view unit,
                                  Dimension dimension, std::string_view meaning) {
    return Parameter{.name = name,
                     .symbol = symbol,
                     .unit = unit,
                     .meaning = meaning,
                     .dimension = dimension,
                     .only_on_chain = true};
  };
  const std::string_view pressure = "normal stress", time = "b / (c A)";
  return {
      on_chain("contact_ageing", "beta", "1", Dimension::number,
               "growth of the contacts' strength a^2 with ln(1 + theta / theta_c)"),
      on_chain("contact_time", "theta_c", time, Dimension::time, "age theta_c from which on the contacts strengthen"),
      on_chain("dilatancy", "epsilon / b_p", pressure, Dimension::pressure,
               "change of pore pressure with ln theta, without drainage"),
      on_chain("drainage_time", "t_p", time, Dimension::time, "time in which the pore pressure returns; 0 means never"),
      with(on_chain("pore_pressure", "p_0", pressure, Dimension::pressure, "ambient pore pressure"), &Parameter::most,
           1.0)};
}

std::vector<Parameter> all_parameters() {
  std::vector<Parameter> all = parameters_of_friction();
  const std::vector<Parameter> contacts = parameters_of_contacts();
  all.insert(all.end(), contacts.begin(), contacts.end());
  return all;
}

}  // namespace

const Definition& rate_and_state_law() {
  static const Definition definition{
      .name = "rate-and-state",
      .adjective = "rate-and-state",
      .equation =
          "f = a asinh((w / 2 w_0) exp((f_0 + b ln(theta w_0 / D_c)) / a)), with the sign of w; ageing: theta_t = 1 - "
          "|w| theta / D_c; slip: theta_t = -x ln x with x = |w| theta / D_c",
      .source =
          "Dieterich (1979), J. Geophys. Res. 84:2161; Ruina (1983), J. Geophys. Res. 88:10359; regularised as by "
          "Rice & Ben-Zion (1996), Proc. Natl. Acad. Sci. 93:3811",
      .parameters = all_parameters(),
      .state = {{.name = "theta", .symbol = "theta", .unit = "b / (c A)"}},
      .make = make_law<RateAndState>};
  return definition;
}

}  // namespace slipfront::friction
