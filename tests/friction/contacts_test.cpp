// Contacts that age, pores, and states at the start, against the formulas of docs/friction.md.

#include "friction/state/contacts.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <string>
#include <vector>

#include "slipfront/friction/friction.hpp"

namespace {

using namespace slipfront;
using namespace slipfront::friction;

Friction rate_and_state_with(const std::map<std::string, double>& given) {
  for (const Definition* law : laws()) {
    if (law->name != "rate-and-state") continue;
    std::vector<double> values;
    for (const Parameter& p : law->parameters) {
      const auto found = given.find(std::string(p.name));
      values.push_back(found == given.end() ? p.value : found->second);
    }
    return {*law, values};
  }
  return {};
}

const std::map<std::string, double> base{
    {"strength", 0.3},          {"direct_effect", 0.01}, {"evolution_effect", 0.015}, {"reference_velocity", 0.05},
    {"characteristic_slip", 2}, {"contact_ageing", 0.4}, {"contact_time", 3},         {"dilatancy", 0.02},
    {"drainage_time", 7},       {"pore_pressure", 0.1}};

TEST(Contacts, HaveTheStrengthOfTheirAgeUnderTheEffectiveStress) {
  const Contacts contacts{.ageing = 0.4, .age = 3, .dilatancy = 0.02, .drainage = 7, .ambient = 0.1};
  EXPECT_NEAR(contacts.strength(6, 0.2), 0.7 * 0.7 * (1 + 0.4 * std::log(3)), 1e-15);
  EXPECT_NEAR(contacts.share(0.2), 0.7, 1e-15);
  const Contacts without{.ageing = 0, .age = 0, .dilatancy = 0.02, .drainage = 7, .ambient = 0.1};
  EXPECT_NEAR(without.strength(6, 0.2), 0.49, 1e-15);
}

/// The pressure obeys p_t = -(p - p_0) / t_p + E d/dt ln(theta), here by Heun's steps.
TEST(Contacts, PoresFollowTheirEquation) {
  const Contacts contacts{.ageing = 0.4, .age = 3, .dilatancy = 0.02, .drainage = 7, .ambient = 0.1};
  const double before = 2, after = 0.3, time = 4, rate = std::log(after / before) / time;
  double excess = 0.05;
  constexpr int steps = 4000;
  for (int i = 0; i < steps; ++i) {
    const auto slope = [&](double p) { return -p / 7 + 0.02 * rate; };
    const double first = slope(excess), second = slope(excess + time / steps * first);
    excess += time / steps * (first + second) / 2;
  }
  EXPECT_NEAR(contacts.excess_after(time, 0.05, before, after), excess, 1e-9);
  double many[] = {0.05}, strength[] = {0};
  contacts.advance(1, time, &before, &after, many, strength);
  EXPECT_NEAR(many[0], excess, 1e-9);
  EXPECT_NEAR(strength[0], contacts.strength(after, excess), 1e-9);
  const Contacts closed{.ageing = 0, .age = 0, .dilatancy = 0.02, .drainage = 0, .ambient = 0};
  EXPECT_NEAR(closed.excess_after(time, 0.05, before, after), 0.05 + 0.02 * std::log(after / before), 1e-15);
}

/// The ratio a over that at the start, at its largest over all ages from the slip at velocity 10 to the end.
TEST(Contacts, GrowAsTheOldestOrMostSuckedOnesDo) {
  for (const double dilatancy : {0.02, 0.3}) {
    auto given = base;
    given["dilatancy"] = dilatancy;
    given["initial_state"] = 5;
    const Friction friction = rate_and_state_with(given);
    const double end = 100, at_start = 0.9 * std::sqrt(1 + 0.4 * std::log1p(5.0 / 3));
    EXPECT_NEAR(friction.contact_at_start(0), at_start, 1e-14);
    double most = 0;
    for (double age = 0.2; age < 5 + end; age *= 1.0005) {
      const double share = 0.9 + dilatancy * std::log((5 + end) / age);
      most = std::max(most, share * std::sqrt(1 + 0.4 * std::log1p(age / 3)) / at_start);
    }
    EXPECT_NEAR(friction.contact_growth(end) / most, 1, 1e-3) << dilatancy;
    EXPECT_GT(most, 1.1);
  }
}

TEST(Contacts, KeepTheirStrengthUnderFrictionThatDoesNotChangeThem) {
  for (const Friction& friction : {coulomb(0.5), rate_and_state_with({{"strength", 0.6}})}) {
    EXPECT_EQ(friction.contact_at_start(0), 1);
    EXPECT_EQ(friction.contact_growth(100), 1);
  }
}

TEST(RateAndState, BeginsWithTheGivenStateOrTheSteadyOne) {
  EXPECT_EQ(rate_and_state_with(base).state_at_start()[0], 2 / 0.05);
  auto given = base;
  given["initial_state"] = 5;
  EXPECT_EQ(rate_and_state_with(given).state_at_start()[0], 5);
}

/// At rest, the relaxation rate of a law that is linear near w = 0 is its limit for slow trains, in sparse trains too.
TEST(RelaxationRateAtRest, IsTheLimitOfSlowTrains) {
  for (const Definition* law : laws()) {
    if (law->name != "n-shaped") continue;
    std::vector<double> values;
    for (const Parameter& p : law->parameters) values.push_back(p.value > 0 ? p.value : 0.2);
    const Friction friction(*law, values);
    const auto rate = friction.relaxation_rate();
    ASSERT_TRUE(rate);
    for (const double psi : {1e-4, 0.01, 0.5})
      EXPECT_NEAR((*rate)({0, psi}, 1, {}) / (*rate)({1e-5 * psi, psi}, 1, {}), 1, 1e-5) << psi;
    // Rates of many trains, by their largest slip velocity in local units.
    const double psi[] = {0.4, 1.2}, fastest[] = {0.1, 0.7};
    double many[2];
    rate->rates(2, fastest, psi, many);
    for (int i = 0; i < 2; ++i) {
      const double phi = std::asinh(fastest[i] / (2 * std::cosh(psi[i])));
      EXPECT_NEAR(many[i] / (*rate)({phi, psi[i]}, 1, {}), 1, 1e-9);
    }
  }
}

}  // namespace
