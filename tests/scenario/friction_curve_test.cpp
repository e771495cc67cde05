#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <thread>
#include <vector>

#include "support.hpp"

namespace slipfront::scenario {
namespace {

std::string friction(const std::string& rest) { return step + "[friction]\n" + rest; }
/// Without stress: a friction law is all that is in SI units.
std::string unstressed(const std::string& rest) {
  return "[initial]\nstress_left = 0\nstress_right = 0\n[friction]\n" + rest;
}
std::string in_si(const std::string& rest) { return si_step + "[friction]\n" + rest; }
std::string formula_law(const std::string& text) { return friction("law = \"formula\"\nformula = \"" + text + "\"\n"); }
Complaint refused_text(const std::string& text, const Rows& rows = {}) {
  return refused([&] { read(text, {}, rows); });
}

TEST(FrictionCurve, AgreesWithTheFormula) {
  const Scenario s = read(formula_law("0.1*w/(1 + w^2)") + "coefficient = 2\n");
  for (const double w : {1e-9, 0.3, 4.0}) EXPECT_DOUBLE_EQ(s.friction.force(-w), -0.2 * w / (1 + w * w));
  EXPECT_FALSE(s.friction.sticks());
  EXPECT_TRUE(read(formula_law("0.1 + 0.2*w")).friction.sticks());
  EXPECT_TRUE(read(formula_law("0.1*sqrt(w)")).friction.steep_at_rest());
  EXPECT_FALSE(read(formula_law("0.1*w")).friction.steep_at_rest());
}

TEST(FrictionCurve, InterpolatesTheTableMonotonically) {
  const Rows rows = {{0, 0.1}, {0.5, 0.3}, {2, 0.2}};
  const Scenario s = read(friction("law = \"table\"\nfile = \"f.csv\"\n"), {}, rows);
  EXPECT_TRUE(s.friction.sticks());
  for (const auto& [w, f] : rows) EXPECT_EQ(s.friction.law().strength(w, {}), f);
  EXPECT_GT(s.friction.force(0.2), 0.1);
  EXPECT_LT(s.friction.force(0.2), 0.3);
  const Complaint beyond = refused([&] { s.friction.force(2.1); });
  EXPECT_EQ(beyond.key, "friction.file");
  EXPECT_TRUE(contains(beyond.problem, "2.1")) << beyond.problem;
}

TEST(FrictionCurve, RejectsCurvesThatAreNotForces) {
  EXPECT_TRUE(contains(refused_text(formula_law("1/w")).problem, "inf at the slip velocity w = 0"));
  EXPECT_TRUE(contains(refused_text(formula_law("w - 0.1")).problem, "-0.1"));
  EXPECT_TRUE(contains(refused_text(formula_law("w > 0 ? 0.1 : 0")).allowed, "coulomb"));
  EXPECT_TRUE(contains(refused_text(formula_law("0.1*v")).problem, "v"));
  EXPECT_EQ(refused_text(friction("law = \"formula\"\n")).key, "friction.formula");
  EXPECT_EQ(refused_text(friction("law = \"viscous\"\ncoefficient = 1\nformula = \"w\"\n")).key, "friction.formula");
  const std::string table = friction("law = \"table\"\nfile = \"f.csv\"\n");
  EXPECT_TRUE(contains(refused_text(table, {{0.1, 1}, {1, 1}}).problem, "begins at w = 0.1"));
  EXPECT_TRUE(contains(refused_text(table, {{0, 1}, {1, 1}, {1, 2}}).problem, "does not increase"));
  EXPECT_TRUE(contains(refused_text(table, {{0, 1}, {1, -1}}).problem, "f = -1"));
}

/// Steep curves are accepted; only a curve that jumps at w = 0 is refused.
TEST(FrictionCurve, AcceptsSteepCurvesAtRest) {
  EXPECT_NEAR(read(formula_law("0.02*w^0.1")).friction.law().strength(1e-10, {}), 0.002, 1e-12);
  EXPECT_NEAR(read(formula_law("0.02*w^0.02")).friction.law().strength(1, {}), 0.02, 1e-12);
  EXPECT_TRUE(contains(refused_text(formula_law("w > 0 ? 0.1 + w : 0")).problem, "jumps from 0 at w = 0 to 0.1"));
}

/// Two threads must not call the parser of a formula at the same time, but they may call the curve.
TEST(FrictionCurve, MayBeCalledByThreads) {
  const friction::Friction f = read(formula_law("0.1*w/(1 + w^2)")).friction;
  std::vector<std::thread> threads;
  std::vector<int> wrong(4);
  for (std::size_t t = 0; t < wrong.size(); ++t)
    threads.emplace_back([&, t] {
      for (int i = 1; i < 2000; ++i) {
        const double w = 1e-3 * i * static_cast<double>(t + 1), want = 0.1 * w / (1 + w * w);
        wrong[t] += std::fabs(f.force(w) - want) > 1e-15;
      }
    });
  for (std::thread& thread : threads) thread.join();
  for (const int count : wrong) EXPECT_EQ(count, 0);
}

TEST(FrictionCurve, AcceptsWordsForNumbers) {
  const std::string text = friction("law = \"rate-and-state\"\nstrength = 0.5\nevolution_effect = 0.02\n");
  EXPECT_EQ(read(text).friction.parameter("state"), 0);
  EXPECT_EQ(read(text + "state = \"slip\"\n").friction.parameter("state"), 1);
  EXPECT_TRUE(contains(refused_text(text + "state = \"slipp\"\n").allowed, "slip"));
  EXPECT_EQ(refused_text(text + "direct_effect = 0\n").key, "friction.direct_effect");
  EXPECT_EQ(refused_text(text + "characteristic_slip = -1\n").key, "friction.characteristic_slip");
}

// Rock and interface are those of the worked examples. The test computes the units of the model without the library.
TEST(FrictionUnits, FollowFromTheMedium) {
  const std::string rock =
      "[medium]\nshear_modulus = \"30 GPa\"\np_wave_speed = \"6 km/s\"\npoisson_ratio = 0.3\ncontact_ratio = "
      "0.01\nasperity_spacing = \"1 mm\"\n";
  const Scenario s = read(in_si("law = \"rate-and-state\"\nnormal_stress = \"50 MPa\"\nstrength = 0.6\n"
                                "direct_effect = 0.01\nevolution_effect = \"0.75 MPa\"\ncharacteristic_slip = \"10 "
                                "um\"\nreference_velocity = \"1 um/s\"\ninitial_state = \"2 s\"\n") +
                          rock);
  const double pi = std::acos(-1), A = 0.01, b = 1e-3, c = 6000 * std::sqrt(1 - 0.6) / 0.7;
  const double traction = 30e9 * A * A / (pi * 0.7);
  const auto is = [&](const char* name, double value) {
    EXPECT_NEAR(s.friction.parameter(name), value, 1e-12 * value) << name;
  };
  is("strength", 0.6 * 50e6 / traction);
  is("direct_effect", 0.01 * 50e6 / traction);
  is("evolution_effect", 0.75e6 / traction);
  is("characteristic_slip", 10e-6 / (b / pi));
  is("reference_velocity", 1e-6 / (c * A / pi));
  is("initial_state", 2 / (b / (c * A)));
  // V / D_c is a rate, so the units of slip, velocity and time must be consistent.
  const double rate = s.friction.parameter("reference_velocity") / s.friction.parameter("characteristic_slip");
  EXPECT_NEAR(rate / (b / (c * A)), 1e-6 / 10e-6, 1e-13);
}

TEST(FrictionUnits, NameMissingConstants) {
  const std::string law = "law = \"slip-weakening\"\nstrength = ";
  EXPECT_TRUE(contains(refused_text(unstressed(law + "\"30 MPa\"\n")).problem, "medium.contact_ratio"));
  const std::string rock = "[medium]\ncontact_ratio = 0.01\n";
  EXPECT_EQ(read(unstressed(law + "\"0.3 MPa\"\n") + rock).warnings.size(), 1u);  // names the assumed constants
  EXPECT_TRUE(contains(refused_text(unstressed(law + "\"0.1 MPa\"\ncharacteristic_slip = \"1 mm\"\n") + rock).problem,
                       "medium.asperity_spacing"));
  EXPECT_TRUE(contains(refused_text(unstressed(law + "\"3 km\"\n") + rock).problem, "km"));
  EXPECT_EQ(refused_text(unstressed(law + "0.6\nnormal_stress = \"-5 MPa\"\n") + rock).key, "friction.normal_stress");
  EXPECT_EQ(refused_text(unstressed("law = \"none\"\nnormal_stress = \"5 MPa\"\n") + rock).key,
            "friction.normal_stress");
  EXPECT_TRUE(
      contains(refused_text(unstressed("law = \"viscous\"\ncoefficient = \"5 MPa\"\n") + rock).problem, "no SI unit"));
}

std::vector<std::string> strength_warnings(const std::string& text, const Rows& rows = {}) {
  std::vector<std::string> found;
  for (const std::string& warning : read(text, {}, rows).warnings)
    if (contains(warning, "friction holds a force")) found.push_back(warning);
  return found;
}

/// In Eq. (3) the force of the substrate, a^2 sin u, is at most a^2.
TEST(FrictionStrength, WarnsIfItExceedsTheStrengthOfTheSubstrate) {
  const std::string contact =
      "[interface]\ncontact = \"1 + x^2 / 10\"\n[domain]\nleft = -4\nright = 3\n";  // the contact ratio is at most 2.6
  for (const char* law : {"coulomb\"\ncoefficient = ", "flash-heating\"\nstrength = ", "slip-weakening\"\nstrength = ",
                          "rate-and-state\"\nstrength = ", "formula\"\nformula = \"1\"\ncoefficient = "}) {
    const std::string text = friction("law = \"" + std::string(law));
    EXPECT_TRUE(strength_warnings(text + "1\n").empty()) << law;
    EXPECT_EQ(strength_warnings(text + "1.01\n").size(), 1u) << law;
    EXPECT_TRUE(strength_warnings(text + "6.7\n" + contact).empty()) << law;
    EXPECT_EQ(strength_warnings(text + "6.8\n" + contact).size(), 1u) << law;
  }
  // If a force falls again with velocity, its maximum is its strength. A force that always rises has no strength.
  const std::string n_shaped = friction("law = \"n-shaped\"\nvelocity = 1e-3\ncoefficient = ");
  EXPECT_TRUE(strength_warnings(n_shaped + "1.99\n").empty());
  EXPECT_EQ(strength_warnings(n_shaped + "2.1\n").size(), 1u);
  EXPECT_TRUE(strength_warnings(friction("law = \"viscous\"\ncoefficient = 50\n")).empty());
  EXPECT_TRUE(strength_warnings("[initial]\nstress_left = 0\nstress_right = 0\n[interface]\ncontact = 0\n"
                                "[friction]\nlaw = \"rate-and-state\"\nstrength = 50\n")
                  .empty());
}

/// Laboratory friction: f_0 = 0.4 at 5 MPa, on an interface whose unit of force is 0.23 MPa.
TEST(FrictionStrength, WarnsForLaboratoryFriction) {
  const std::string text = friction("law = \"rate-and-state\"\nnormal_stress = \"5 MPa\"\nstrength = 0.4\n") +
                           "[medium]\nshear_modulus = \"30 GPa\"\npoisson_ratio = 0.3\np_wave_speed = \"6 km/s\"\n"
                           "contact_ratio = 0.0041\nasperity_spacing = \"1 mm\"\n";
  const std::vector<std::string> warnings = strength_warnings(text);
  ASSERT_EQ(warnings.size(), 1u);
  EXPECT_TRUE(contains(warnings[0], "8.72 times")) << warnings[0];
}

}  // namespace
}  // namespace slipfront::scenario
