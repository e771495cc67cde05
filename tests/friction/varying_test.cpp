// Friction whose parameters vary along the interface is at each position the law with the values there.

#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "friction/state/contacts.hpp"
#include "slipfront/error.hpp"
#include "slipfront/friction/friction.hpp"

namespace slipfront::friction {
namespace {

/// All laws, with parameters at which their forces act. A curve has no other parameter than its factor.
std::vector<Friction> all_frictions() {
  std::vector<Friction> all;
  for (const Definition* law : laws()) {
    std::vector<double> values;
    for (const Parameter& p : law->parameters) {
      const bool number = p.words.empty() && !p.only_on_chain;
      values.push_back(number ? std::fmin(p.most, 0.3 + 0.1 * static_cast<double>(values.size())) : p.value);
    }
    const Curve curve = [](double speed) { return 0.2 + speed / (1 + speed); };
    if (!values.empty())
      all.emplace_back(*law, values, Closure::consistent, law->curve == CurveSource::none ? Curve{} : curve);
  }
  return all;
}

bool may_vary(const Parameter& p) { return p.words.empty() && !p.only_on_chain; }

/// A value of a parameter that varies by a factor of two.
AlongInterface varied(double value) {
  return {[value](double x, double y) { return value * (0.75 + 0.25 * std::sin(x + 2 * y)); }, 0.5 * value, value};
}

/// Compares `friction`, which varies, with the law of the same values at positions.
void expect_the_law_there(const Friction& friction, const std::vector<std::string>& varying, const std::string& what) {
  constexpr std::size_t size = 70;  // more than the loops treat at once
  const std::size_t each = friction.state_size();
  std::vector<double> state(each * size), free(size), speed(size), force(size), typical(size), mean(size), slope(size),
      s(size);
  std::vector<Friction> there;
  std::vector<std::vector<double>> own(size);
  for (std::size_t i = 0; i < size; ++i) {
    const double x = 0.1 * static_cast<double>(i), y = 0.05 * static_cast<double>(i);
    friction.start(x, y, std::span(state).subspan(i * each, each));
    Friction local = friction;
    for (const std::string& name : varying) local = local.with(name, varied(friction.parameter(name)).at(x, y));
    own[i] = local.state_at_start();
    free[i] = 0.01 * std::pow(1.1, static_cast<double>(i));
    s[i] = 0.1 + 0.01 * static_cast<double>(i);
    there.push_back(local);
  }
  friction.evolution().advance_all(size, {free.data(), free.data()}, 0.3, {state.data(), each});
  friction.loops().strengths(size, free.data(), {state.data(), each}, force.data());
  friction.loops().speeds_after(size, free.data(), 0.1, {state.data(), each}, speed.data());
  friction.average().mean_strengths({size, free.data(), s.data(), {state.data(), each}}, Closure::consistent,
                                    mean.data(), slope.data());
  for (std::size_t i = 0; i < size; ++i) {
    there[i].evolution().advance(Slip::at(free[i]), 0.3, own[i]);
    const LocalState at(state.data() + i * each, each);
    const std::string where = what + " at " + std::to_string(i);
    for (std::size_t v = 0; v < own[i].size(); ++v) EXPECT_NEAR(at[v], own[i][v], 1e-12 * own[i][v]) << where;
    const double strength = there[i].law().strength(free[i], own[i]);
    EXPECT_NEAR(force[i], strength, 1e-7 * strength) << where;  // a drawn curve has a table
    EXPECT_NEAR(friction.force(free[i], at), strength, 1e-12 * strength) << where;
    EXPECT_NEAR(speed[i], there[i].law().speed_after(free[i], 0.1, own[i]), 1e-7 * free[i]) << where;
    const double psi = std::atanh(s[i]), phi = std::asinh(free[i] / (2 * std::cosh(psi)));
    const double wanted = there[i].mean_strength({phi, psi}, 1, own[i]);
    EXPECT_NEAR(mean[i], wanted, 1e-7 * wanted) << where;
    EXPECT_NEAR(friction.mean_strength({phi, psi}, 1, at), wanted, 1e-9 * wanted) << where;
    const auto rate = friction.relaxation_rate(), local_rate = there[i].relaxation_rate();
    const double expected = (*local_rate)({phi, psi}, 1, own[i]);
    EXPECT_NEAR((*rate)({phi, psi}, 1, at), expected, 1e-7 * expected) << where;
  }
}

TEST(VaryingFriction, IsAtEachPositionTheLawWithTheParametersThere) {
  for (const Friction& friction : all_frictions()) {
    std::vector<std::string> names;
    Friction all = friction;
    for (const Parameter& p : friction.definition().parameters) {
      if (!may_vary(p)) continue;
      const std::string name(p.name);
      names.push_back(name);
      const AlongInterface value = varied(friction.parameter(name));
      all = all.with(name, value);
      expect_the_law_there(friction.with(name, value), {name}, std::string(friction.name()) + ", " + name);
    }
    expect_the_law_there(all, names, std::string(friction.name()) + ", all");
  }
}

/// f_0 / a from 0.3 to 4000, of which e^(f_0 / a) is no double.
TEST(VaryingFriction, IsTheLawThereForAnyRatioOfStrengthToDirectEffect) {
  for (const Friction& friction : all_frictions()) {
    if (friction.definition().find("direct_effect") == nullptr) continue;
    for (const double a : {1.0, 1e-2, 6e-4, 4e-4, 1e-4}) {
      const Friction rock = friction.with("direct_effect", a).with("evolution_effect", 0.5 * a);
      expect_the_law_there(rock.with("direct_effect", varied(a)), {"direct_effect"}, "a = " + std::to_string(a));
    }
  }
}

TEST(VaryingFriction, IsUniformAtAPosition) {
  for (const Friction& friction : all_frictions()) {
    Friction varying = friction.under(varied(1));
    for (const Parameter& p : friction.definition().parameters)
      if (may_vary(p)) varying = varying.with(std::string(p.name), varied(friction.parameter(p.name)));
    std::vector<double> state(varying.state_size());
    varying.start(0.3, 0.4, state);
    const Friction there = varying.at(0.3, 0.4);
    const double strength = varying.force(0.2, state);
    EXPECT_NEAR(there.force(0.2, there.state_at_start()), strength, 1e-12 * strength) << friction.name();
    EXPECT_FALSE(there.varies());
  }
}

TEST(VaryingFriction, IsProportionalToTheNormalStress) {
  const AlongInterface share = varied(1);
  for (const Friction& friction : all_frictions()) {
    const Friction under = friction.under(share);
    std::vector<double> state(under.state_size());
    under.start(0.7, 0.2, state);
    const double strength = friction.law().strength(0.4, friction.state_at_start());
    EXPECT_NEAR(under.force(-0.4, state), -share.at(0.7, 0.2) * strength, 1e-12) << friction.name();
    EXPECT_EQ(under.steep_at_rest(), friction.steep_at_rest()) << friction.name();
  }
}

/// The normal stress multiplies the force. It does not change how the state evolves.
TEST(VaryingFriction, EvolvesEquallyUnderAnyNormalStress) {
  const std::vector<double> slip = {0.4, 0.02, 0};
  for (const Friction& friction : all_frictions()) {
    const Friction under = friction.under(varied(1));
    const std::size_t each = under.state_size();
    std::vector<double> states(each * slip.size());
    for (std::size_t i = 0; i < slip.size(); ++i) under.start(0.7, 0.2, std::span(states).subspan(i * each, each));
    under.evolution().advance_all(slip.size(), Slips::at(slip.data()), 0.3, {states.data(), each});
    for (std::size_t i = 0; i < slip.size(); ++i) {
      std::vector<double> own = friction.state_at_start();
      friction.evolution().advance(Slip::at(slip[i]), 0.3, own);
      own.push_back(varied(1).at(0.7, 0.2));
      for (std::size_t v = 0; v < each; ++v)
        EXPECT_NEAR(states[i * each + v], own[v], 1e-12 * own[v]) << friction.name() << " " << slip[i];
    }
  }
}

TEST(VaryingFriction, HasNoStrengthWithoutNormalStress) {
  const AlongInterface none{[](double, double) { return 0; }, 0, 0};
  const Friction friction = coulomb(0.5).with("coefficient", varied(0.4)).under(none);
  EXPECT_EQ(friction.strength_at_rest(), 0);
  EXPECT_GT(friction.under(varied(1)).strength_at_rest(), 0);
}

TEST(VaryingFriction, ScalesAsItsLawDoes) {
  constexpr double scale = 40;
  for (const Friction& friction : all_frictions()) {
    Friction varying = friction.under(varied(1));
    for (const Parameter& p : friction.definition().parameters)
      if (may_vary(p)) varying = varying.with(std::string(p.name), varied(friction.parameter(p.name)));
    const Friction scaled = varying.scaled_by(scale);
    std::vector<double> state(varying.state_size()), of_scaled(state.size());
    varying.start(0.3, 0.4, state);
    scaled.start(0.3 * scale, 0.4 * scale, of_scaled);
    const double strength = varying.force(0.2, state) / scale;
    EXPECT_NEAR(scaled.force(0.2, of_scaled), strength, 1e-12 * strength) << friction.name();
  }
}

TEST(VaryingFriction, HasNoCoefficientOfItsOwnButOneAtEachPosition) {
  const Friction friction = viscous(0.5).with("coefficient", varied(0.4));
  EXPECT_FALSE(friction.linear_coefficient());
  EXPECT_NEAR(friction.linear_coefficient(0.3, 0.1).value(), varied(0.4).at(0.3, 0.1), 1e-15);
  EXPECT_EQ(viscous(0.5).linear_coefficient(1, 1).value(), 0.5);
  EXPECT_FALSE(coulomb(0.5).with("coefficient", varied(0.4)).linear_coefficient(0, 0));
}

/// The growth of contacts whose numbers vary bounds that at each position.
TEST(VaryingFriction, ChangesContactsByTheNumbersOfEachPosition) {
  for (const Definition* law : laws()) {
    if (law->find("contact_ageing") == nullptr) continue;
    std::vector<double> values;
    for (const Parameter& p : law->parameters) values.push_back(p.words.empty() ? std::fmin(p.most, 0.5) : 0);
    Friction friction(*law, values);
    for (const Parameter& p : law->parameters)
      if (p.words.empty()) friction = friction.with(p.name, varied(friction.parameter(p.name)));
    for (const double x : {-2.0, 0.3, 1.0}) {
      std::vector<double> state(friction.state_size());
      friction.start(x, 0, state);
      const Friction there = friction.at(x, 0);
      const Contacts contacts = friction.contacts_at(state), uniform = there.contacts();
      EXPECT_EQ(contacts.strength(3, 0.1), uniform.strength(3, 0.1));
      EXPECT_EQ(contacts.excess_after(0.2, 0.1, 3, 4), uniform.excess_after(0.2, 0.1, 3, 4));
      EXPECT_NEAR(friction.contact_at_start(x), there.contact_at_start(0), 1e-14);
      EXPECT_GE(friction.contact_growth(10), there.contact_growth(10) * (1 - 1e-12));
    }
  }
}

}  // namespace
}  // namespace slipfront::friction
