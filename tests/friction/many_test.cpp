// Compares the vector loops over many positions or trains with the functions for a single one.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <string>
#include <vector>

#include "slipfront/error.hpp"
#include "slipfront/friction/friction.hpp"

namespace {

using namespace slipfront;
using namespace slipfront::friction;

std::vector<Friction> some_of_each(Closure closure = Closure::consistent) {
  std::vector<Friction> all;
  const auto add = [&](const std::string& name, const std::vector<double>& values, const Curve& curve = {}) {
    for (const Definition* law : laws())
      if (law->name == name) all.push_back({*law, values, closure, curve});
  };
  add("formula", {0.5}, [](double w) { return w / (1 + w); });
  add("formula", {0.1}, [](double w) { return std::sqrt(w); });
  add("formula", {0.1}, [](double w) { return (w / 0.05) / (1 + (w / 0.05) * (w / 0.05)); });
  add("viscous", {0.3});
  add("coulomb", {0.03});
  add("power", {0.2, 1.7});
  add("power", {0.1, 0.5});
  add("power", {0.1, 2});
  add("n-shaped", {0.1, 0.05});
  add("flash-heating", {0.05, 0.01, 0.1});
  if (closure == Closure::paper) return all;
  add("slip-weakening", {0.08, 0.02, 0.1});
  add("rate-and-state", {0.05, 0.01, 0.015, 0.05, 0.05, 0, 0});
  add("rate-and-state", {0.05, 0.015, 0.01, 0.05, 0.05, 0, 1});
  add("rate-and-state", {0.6, 0.01, 0.015, 0.05, 1e-6, 0, 0});
  add("rate-and-state", {6, 0.01, 0.015, 0.05, 1e-6, 0, 0});  // exp(600) exceeds the range of the vector code
  return all;
}

/// The normal stress differs from position to position.
TEST(FrictionOfMany, SolvesUnderVariableNormalStressAsForOnePosition) {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> u(0, 1);
  std::vector<Friction> all;
  for (const Definition* law : laws())
    if (law->name == "rate-and-state")
      for (const double b : {0.015, 1e-5, 0.0}) all.push_back({*law, {0.05, 0.01, b, 0.05, 0.05, 0, 0}});
  for (const Friction& f : all) {
    constexpr std::size_t size = 200;
    std::vector<double> share(size), free(size), theta(size), speed(size);
    for (std::size_t i = 0; i < size; ++i) {
      share[i] = 2 * u(random) + 1e-3;
      free[i] = std::pow(10.0, 4 * u(random) - 4);
      theta[i] = std::pow(10.0, 6 * u(random) - 3);
    }
    for (const double weight : {0.1, 2.0}) {
      f.loops().speeds_after_under(size, share.data(), free.data(), weight, {theta.data(), 1}, speed.data());
      for (std::size_t i = 0; i < size; ++i) {
        const double one = f.law().speed_after(free[i], weight * share[i], {&theta[i], 1});
        EXPECT_NEAR(speed[i], one, 1e-12 * free[i] + 1e-9 * one) << share[i] << ' ' << free[i] << ' ' << theta[i];
      }
    }
  }
}

TEST(FrictionOfMany, FindsTheMeanOfEachTrain) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> u(0, 1);
  for (const Closure closure : {Closure::consistent, Closure::paper})
    for (const Friction& friction : some_of_each(closure)) {
      constexpr std::size_t count = 300;
      std::vector<double> phi(count), psi(count), fastest(count), s(count), theta(count), mean(count), slope(count);
      for (std::size_t i = 0; i < count; ++i) {
        psi[i] = std::exp(i % 5 == 0 ? -40 * u(random) : -9 + 11 * u(random));
        phi[i] = std::exp(-20 + 21 * u(random));
        fastest[i] = 2 * std::sinh(phi[i]) * std::cosh(psi[i]);
        s[i] = std::tanh(psi[i]);
        theta[i] = std::exp(4 * u(random) - 2);
      }
      const std::size_t each = friction.state_size();
      const double precision = each > 0 ? 1e-7 : 1e-5;  // most other laws have differences as slopes
      friction.average().mean_strengths({count, fastest.data(), s.data(), {theta.data(), each}}, closure, mean.data(),
                                        slope.data());
      for (std::size_t i = 0; i < count; ++i) {
        const auto of_one = [&](double faster) {
          const double at = std::asinh(std::sinh(phi[i]) * faster);
          return friction.average().mean_strength({at, psi[i]}, 1, closure, LocalState(&theta[i], each));
        };
        EXPECT_NEAR(mean[i] / of_one(1), 1, 3e-10) << friction.name() << " phi " << phi[i] << " psi " << psi[i];
        constexpr double h = 1e-2;
        const auto chord = [&](double by) { return (of_one(std::exp(by)) - of_one(std::exp(-by))) / (2 * by); };
        const double want = (4 * chord(h) - chord(2 * h)) / 3;
        EXPECT_NEAR(slope[i], want, precision * of_one(1)) << friction.name() << " phi " << phi[i] << " psi " << psi[i];
      }
    }
}

/// A resumed run computes means for other groups of trains than an uninterrupted run, because each already has the
/// means of some cells at rest. The bits must not depend on the group.
TEST(FrictionOfMany, FindsMeansThatDoNotDependOnTheOtherTrains) {
  std::mt19937 random(11);
  std::uniform_real_distribution<double> u(0, 1);
  constexpr std::size_t count = 150;
  for (const Closure closure : {Closure::consistent, Closure::paper})
    for (const Friction& friction : some_of_each(closure)) {
      std::vector<double> fastest(count), s(count), theta(count), together(count), alone(count);
      for (std::size_t i = 0; i < count; ++i) {
        fastest[i] = std::exp(-12 + 12 * u(random));
        s[i] = std::tanh(std::exp(-12 + 12 * u(random)));
        theta[i] = std::exp(4 * u(random) - 2);
      }
      const std::size_t each = friction.state_size();
      const auto means = [&](std::size_t begin, std::size_t end, std::vector<double>& to) {
        friction.average().mean_strengths({end - begin, &fastest[begin], &s[begin], {&theta[begin], each}}, closure,
                                          &to[begin], nullptr);
      };
      means(0, count, together);
      for (std::size_t begin = 0, end = 1; begin < count; begin = end, end = std::min(count, 2 * end + 1))
        means(begin, end, alone);
      EXPECT_EQ(together, alone) << friction.name();
    }
}

/// Trains that are all of one kind have loops of their own.
TEST(FrictionOfMany, FindsEqualMeansOfEqualTrains) {
  constexpr std::size_t count = 150;
  for (const Friction& friction : some_of_each())
    for (const double speed : {1e-3, 0.3, 30.0})
      for (const double ratio : {0.01, 0.5, 0.99}) {
        const std::size_t each = friction.state_size();
        const std::vector<double> fastest(count, speed), s(count, ratio), theta(count, 0.7);
        std::vector<double> mean(count), slope(count), one(1), slope_of_one(1);
        const auto find = [&](std::size_t size, std::vector<double>& to, std::vector<double>& slopes) {
          friction.average().mean_strengths({size, fastest.data(), s.data(), {theta.data(), each}}, Closure::consistent,
                                            to.data(), slopes.data());
        };
        find(count, mean, slope);
        find(1, one, slope_of_one);
        EXPECT_EQ(mean, std::vector<double>(count, one[0])) << friction.name();
        EXPECT_EQ(slope, std::vector<double>(count, slope_of_one[0])) << friction.name();
      }
}

/// The curve has a kink and an end. A table of its means must not cross the kink or pass the end.
TEST(FrictionOfMany, FindsMeansOfACurveWithAKinkAndAnEnd) {
  constexpr double kink = 0.05, end = 0.1;
  const auto curve = [](double w) {
    if (w > end) throw InputError({.key = "w", .problem = "past the end"});
    return w < kink ? w : kink;
  };
  std::vector<Friction> both;
  for (const Definition* law : laws()) {
    if (law->name == "formula") both.push_back({*law, {1}, Closure::consistent, curve});
    if (law->name == "viscous") both.insert(both.begin(), {*law, {1}, Closure::consistent, {}});
  }
  const auto means = [&](const Friction& friction, double fastest) {
    std::vector<double> speeds, s, mean(100);
    for (int i = 0; i < 100; ++i) {
      speeds.push_back(fastest);
      s.push_back(0.005 + 0.0099 * i);
    }
    friction.average().mean_strengths({100, speeds.data(), s.data(), {}}, Closure::consistent, mean.data(), nullptr);
    return mean;
  };
  for (int step = 0; step < 232; ++step) {
    const double fastest = 1e-3 * std::pow(1.02, step);  // to 0.097
    const std::vector<double> linear = means(both[0], fastest), bent = means(both[1], fastest);
    for (std::size_t i = 0; i < bent.size(); ++i) {
      EXPECT_LE(bent[i], std::fmin(linear[i], kink) * (1 + 1e-9)) << fastest;
      if (fastest < kink) {
        EXPECT_NEAR(bent[i] / linear[i], 1, 3e-10) << fastest;
      }
      if (fastest * (0.005 + 0.0099 * static_cast<double>(i)) > kink) {  // all of the train is faster than the kink
        EXPECT_NEAR(bent[i], kink, 1e-12);
      }
    }
  }
  EXPECT_THROW(means(both[1], 1.01 * end), InputError);
}

TEST(FrictionOfMany, FindsForcesAndSolvesAsForOnePosition) {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> u(0, 1);
  for (const Friction& friction : some_of_each())
    for (const double weight : {1e-7, 1e-3, 0.1, 30.0}) {
      constexpr std::size_t count = 203;
      std::vector<double> free(count), theta(count), speed(count), force(count);
      for (std::size_t i = 0; i < count; ++i) {
        free[i] = i % 7 == 0 ? 0 : std::pow(10, i % 5 == 0 ? -300 * u(random) : -12 + 13 * u(random));
        theta[i] = std::exp(8 * u(random) - 4);
      }
      const LocalStates states{theta.data(), friction.state_size()};
      friction.loops().strengths(count, free.data(), states, force.data());
      friction.loops().speeds_after(count, free.data(), weight, states, speed.data());
      for (std::size_t i = 0; i < count; ++i) {
        const double f = friction.law().strength(free[i], states.at(i));
        EXPECT_NEAR(force[i], f, 1e-12 * f) << friction.name() << " " << free[i];
        const double v = friction.law().speed_after(free[i], weight, states.at(i));
        EXPECT_NEAR(speed[i], v, 2e-12 * v + 1e-14 * free[i]) << friction.name() << " " << weight << " " << free[i];
        // The result does not depend on the other positions.
        double alone = -1;
        friction.loops().speeds_after(1, &free[i], weight, states.from(i), &alone);
        EXPECT_EQ(alone, speed[i]) << friction.name() << " " << weight << " " << free[i];
      }
    }
}

/// A step that is a rounding error of its start, or of a thousandth, is none.
TEST(FrictionOfMany, IgnoresStepsThatAreRoundingErrors) {
  const double from[] = {10, 10, -10, 0, 0}, end[] = {10 + 1e-14, 10 + 1e-13, -10 - 1e-13, 1e-18, 1e-17};
  double next[5];
  std::copy_n(end, 5, next);
  power(0.1, 1.7).loops().slow_steps(5, {4, from, next}, nullptr, 1e-6, {}, nullptr);
  for (const std::size_t j : {0u, 3u}) EXPECT_EQ(next[j], from[j]) << j;
  for (const std::size_t j : {1u, 2u, 4u}) EXPECT_NEAR((next[j] - from[j]) / (end[j] - from[j]), 1, 0.02) << j;
}

/// Steps in one loop are those of the separate loops, and so are powers.
TEST(FrictionOfMany, SlowsStepsAsSpeeds) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> u(-1, 1);
  for (const Friction& friction : some_of_each()) {
    constexpr std::size_t count = 203;
    std::vector<double> from(count), next(count), theta(count), share(count), applied(count), power(count);
    for (std::size_t i = 0; i < count; ++i) {
      from[i] = 3 * u(random);
      next[i] = from[i] + (i % 7 == 0 ? 0 : u(random) * std::pow(10, -8 + static_cast<double>(i % 9)));
      theta[i] = std::exp(4 * u(random));
      share[i] = 0.6 + 0.3 * u(random);
    }
    const LocalStates states{theta.data(), friction.state_size()};
    constexpr double per_step = 0.7, weight = 0.4;
    for (const double* const under : {static_cast<const double*>(nullptr), static_cast<const double*>(share.data())}) {
      std::vector<double> moved = next, alone = next;
      friction.loops().slow_steps(count, {per_step, from.data(), moved.data()}, under, weight, states, applied.data());
      friction.loops().slow_steps(count, {per_step, from.data(), alone.data()}, under, weight, states, nullptr);
      for (std::size_t i = 0; i < count; ++i) {
        const double part = under == nullptr ? 1 : share[i], free = per_step * std::fabs(next[i] - from[i]);
        const double v = friction.law().speed_after(free, weight * part, states.at(i));
        EXPECT_NEAR(per_step * std::fabs(moved[i] - from[i]), v, 1e-11 * v + 1e-14) << friction.name() << " " << i;
        EXPECT_NEAR(std::fabs(applied[i]) * weight, free - v, 1e-11 * free + 1e-14) << friction.name() << " " << i;
        EXPECT_NEAR(alone[i], moved[i], 1e-14) << friction.name() << " " << i;
        EXPECT_GE((moved[i] - from[i]) * (next[i] - from[i]), 0) << friction.name() << " " << i;
      }
    }
    friction.loops().powers(count, per_step, from.data(), states, power.data());
    for (std::size_t i = 0; i < count; ++i) {
      const double w = per_step * std::fabs(from[i]), wanted = w * friction.law().strength(w, states.at(i));
      EXPECT_NEAR(power[i], wanted, 1e-12 * wanted) << friction.name() << " " << i;
    }
  }
}

TEST(FrictionOfMany, AdvancesStatesAsForOnePosition) {
  for (const Friction& friction : some_of_each()) {
    if (friction.state_size() == 0) continue;
    for (const double time : {1e-3, 1.0, 1e3}) {
      std::vector<double> velocity, typical, all, in_train;
      for (int i = 0; i < 150; ++i) {
        velocity.push_back(i % 9 == 0 ? 0 : std::pow(10, -12 + 0.1 * i) * (i % 2 == 0 ? 1 : -1));
        typical.push_back(std::fabs(0.7 * velocity.back()));
        all.push_back(std::exp(4 * std::sin(1.7 * i)));
      }
      in_train = all;
      const std::vector<double> before = all;
      friction.evolution().advance_all(all.size(), Slips::at(velocity.data()), time, {all.data(), 1});
      friction.evolution().advance_all(all.size(), {velocity.data(), typical.data()}, time, {in_train.data(), 1});
      for (std::size_t i = 0; i < all.size(); ++i) {
        double one[] = {before[i]}, train[] = {before[i]}, alone = before[i];
        friction.evolution().advance(Slip::at(velocity[i]), time, one);
        friction.evolution().advance({velocity[i], typical[i]}, time, train);
        friction.evolution().advance_all(1, Slips::at(&velocity[i]), time, {&alone, 1});
        EXPECT_NEAR(all[i] / one[0], 1, 1e-12) << friction.name() << " " << velocity[i] << " " << time;
        EXPECT_NEAR(in_train[i] / train[0], 1, 1e-12) << friction.name() << " " << velocity[i] << " " << time;
        EXPECT_EQ(all[i], alone) << friction.name() << " " << velocity[i] << " " << time;
      }
    }
  }
}

/// The test covers rest, kinks, jumps, a speed above all previous ones, and a curve that ends.
TEST(FrictionOfMany, FollowsACurveWhereItIsNotSmooth) {
  const Curve curves[] = {[](double w) { return 0.2 + std::fmin(w, 0.1); }, [](double w) { return std::fabs(w - 0.3); },
                          [](double w) { return w < 0.2 ? w : 0.5 * w; }, [](double w) { return 1 - std::exp(-w); },
                          [](double w) {
                            if (w > 0.7) throw InputError({.problem = "ends"});
                            return w * w;
                          }};
  const Definition* formula = nullptr;
  for (const Definition* law : laws())
    if (law->name == "formula") formula = law;
  for (const Curve& curve : curves) {
    const Friction friction(*formula, {3}, Closure::consistent, curve);
    std::vector<double> speed{0, 1e-300, 0.1, 0.2, 0.3}, force(2005);
    for (int i = 0; i < 2000; ++i) speed.push_back(0.7 * std::pow(10, -0.015 * i));
    friction.loops().strengths(speed.size(), speed.data(), {}, force.data());
    for (std::size_t i = 0; i < speed.size(); ++i)
      EXPECT_NEAR(force[i], 3 * curve(speed[i]), 1e-12 * force[i]) << speed[i];
  }
  const Friction ends(*formula, {3}, Closure::consistent, curves[4]),
      goes_on(*formula, {3}, Closure::consistent, curves[0]);
  const double fast = 0.71, fastest = 1e5;
  double force = 0;
  EXPECT_THROW(ends.loops().strengths(1, &fast, {}, &force), InputError);
  goes_on.loops().strengths(1, &fastest, {}, &force);
  EXPECT_DOUBLE_EQ(force, 0.9);
}

}  // namespace
