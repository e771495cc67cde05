// Numbers of [friction] that vary along the interface: by formulas, tables, and a normal stress.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "slipfront/error.hpp"
#include "slipfront/scenario/quantities.hpp"
#include "support.hpp"

namespace slipfront::scenario {
namespace {

const std::string domain = "[domain]\nleft = -2\nright = 2\n[friction]\n";
const std::string ageing = step + domain + "law = \"rate-and-state\"\nstrength = 0.3\nevolution_effect = 0.02\n";

/// The values of friction that solvers keep at x.
std::vector<double> state_at(const Scenario& s, double x) {
  std::vector<double> state(s.friction.state_size());
  s.friction.start(x, 0, state);
  return state;
}

TEST(VaryingFrictionOfAScenario, IsAFormulaOfX) {
  const Scenario s = read(ageing + "direct_effect = \"0.02 + 0.005*x\"\n");
  EXPECT_EQ(s.friction.state_names(), (std::vector<std::string>{"theta", "direct_effect"}));
  EXPECT_NEAR(state_at(s, 1)[1], 0.025, 1e-15);
  EXPECT_NEAR(s.friction.parameter("direct_effect"), 0.03, 1e-15);  // the largest
}

TEST(VaryingFrictionOfAScenario, IsAColumnOfATableLinearBetweenItsRows) {
  const Scenario s =
      read(ageing + "direct_effect = { file = \"a.csv\", column = \"a\" }\n", {}, {{-2, 0.01}, {0, 0.03}, {2, 0.02}});
  EXPECT_NEAR(state_at(s, -1)[1], 0.02, 1e-15);
  EXPECT_NEAR(state_at(s, 2)[1], 0.02, 1e-15);
  const std::string table = ageing + "direct_effect = { file = \"a.csv\", column = \"a\" }\n";
  EXPECT_TRUE(contains(refused(table, {}, {{-1, 0.01}, {2, 0.02}}).problem, "no value at x = -2"));
  EXPECT_TRUE(contains(refused(table, {}, {{-2, 0.01}, {0, 0.02}, {-1, 0.02}, {2, 0.02}}).problem,
                       "row 3: x = -1 does not increase"));
  EXPECT_TRUE(contains(refused(table, {}, {{-2, 0.01}, {0, 0}, {2, 0.02}}).problem, "row 2: a = 0"));
  EXPECT_EQ(refused(ageing + "direct_effect = { file = \"a.csv\" }\n").problem, "not a column of a table");
}

TEST(VaryingFrictionOfAScenario, NamesThePositionOfAValueThatIsNotAllowed) {
  const Complaint negative = refused(ageing + "characteristic_slip = \"1 + x\"\n");
  EXPECT_EQ(negative.key, "friction.characteristic_slip");
  EXPECT_TRUE(contains(negative.problem, "is -1 at x = -2")) << negative.problem;
  EXPECT_EQ(negative.allowed, "a finite number > 0");
  EXPECT_TRUE(contains(refused(ageing + "characteristic_slip = \"1/x/0\"\n").problem, "at x = -2"));
  EXPECT_TRUE(contains(refused(ageing + "characteristic_slip = \"2 + y\"\n").problem, "'y'"));
}

TEST(VaryingFrictionOfAScenario, IsUniformIfTheFormulaIs) {
  const Scenario s = read(ageing + "direct_effect = \"0.02 + 0*x\"\n");
  EXPECT_FALSE(s.friction.varies());
  EXPECT_EQ(s.friction.parameter("direct_effect"), 0.02);
}

const std::string rock =
    "[medium]\nshear_modulus = \"30 GPa\"\ndensity = \"2700 kg/m3\"\npoisson_ratio = 0.25\ncontact_ratio = 0.01\n"
    "asperity_spacing = \"1 mm\"\n";

TEST(VaryingFrictionOfAScenario, ScalesForcesByTheNormalStress) {
  const std::string text =
      "[initial]\nstress_left = 0\nstress_right = 0\n" + rock + "[domain]\nleft = \"-2 m\"\nright = \"2 m\"\n";
  const std::string law =
      "[friction]\nlaw = \"rate-and-state\"\nevolution_effect = 0.01\ncharacteristic_slip = \"1 um\"\n";
  const Scenario low = read(text + law + "strength = 0.6\nnormal_stress = \"1 MPa\"\n"),
                 high = read(text + law + "strength = 0.6\nnormal_stress = \"3 MPa\"\n");
  const Scenario varies =
      read(text + law + "units = \"SI\"\nstrength = 0.6\nnormal_stress = \"2e6 + 0.5e6*x\"\n");  // x in m
  const double metre = varies.domain.right.value() / 2;
  for (const auto& [x, uniform] : {std::pair{-2.0, &low}, {2.0, &high}}) {
    const double wanted = uniform->friction.force(0.1, uniform->friction.state_at_start());
    EXPECT_NEAR(varies.friction.force(0.1, state_at(varies, x * metre)), wanted, 1e-12 * wanted);
  }
  // A strength in Pa does not follow the normal stress, unlike the other forces.
  const Scenario fixed =
      read(text + law + "units = \"SI\"\nstrength = \"0.6 MPa\"\nnormal_stress = \"2e6 + 0.5e6*x\"\n");
  const double wanted = low.friction.force(0.1, low.friction.state_at_start());
  EXPECT_NEAR(fixed.friction.force(0.1, state_at(fixed, -2 * metre)), wanted, 1e-12 * wanted);
  EXPECT_TRUE(contains(refused(text + law + "units = \"SI\"\nstrength = 0.6\nnormal_stress = \"1e6*x\"\n").problem,
                       "friction.normal_stress is -2e+06 at x = "));
  EXPECT_TRUE(contains(refused(text + "[friction]\nlaw = \"coulomb\"\ncoefficient = \"1e4*(2 + x)\"\n").problem,
                       "no units are given"));
}

TEST(VaryingFrictionOfAScenario, IsAFactorOfACurve) {
  const std::string text = "[initial]\nstress_left = 0\nstress_right = 0\n" + rock +
                           "[domain]\nleft = \"-2 m\"\nright = \"2 m\"\n[friction]\nlaw = \"formula\"\n"
                           "formula = \"1e3 + 1e4*w\"\nunits = \"SI\"\ncoefficient = ";
  const Scenario one = read(text + "1\n"), same = read(text + "\"1 + 0*x\"\n");
  const double force = one.friction.force(0.1, {});
  EXPECT_EQ(same.friction.force(0.1, {}), force);
  const double end = one.domain.right.value();
  for (const std::string coefficient : {"\"1.5 + 0.25*x\"\n", "{ file = \"c.csv\", column = \"c\" }\n"}) {
    const Scenario varies = read(text + coefficient, {}, {{-2, 1}, {2, 2}});
    EXPECT_NEAR(varies.friction.force(0.1, state_at(varies, -end)), force, 1e-12 * force);
    EXPECT_NEAR(varies.friction.force(0.1, state_at(varies, end)), 2 * force, 1e-12 * force);
  }
}

TEST(VaryingFrictionOfAScenario, ChangesContactsAndPoresByTheNumbersThere) {
  const std::string text = ageing + "contact_ageing = \"0.1 + 0.02*x\"\ncontact_time = \"1 + x^2\"\n";
  const Scenario s = read(text), there = read(ageing + "contact_ageing = 0.12\ncontact_time = 2\n");
  EXPECT_NEAR(s.contact_at(1), there.contact_at(1), 1e-15);
  EXPECT_GT(std::fabs(s.contact_at(-1) - there.contact_at(1)), 1e-3);
  EXPECT_TRUE(contains(refused(text, {"friction.contact_time=2 + x"}).problem, "friction.contact_time is 0 at x = -2"));
  // A pressure in Pa is a larger share where the normal stress is low.
  const std::string pores =
      "[friction]\nlaw = \"rate-and-state\"\nunits = \"SI\"\ndrainage_time = \"1 s\"\n"
      "normal_stress = \"2e6 + 0.5e6*x\"\ncharacteristic_slip = \"1 um\"\nstrength = 0.6\n"
      "dilatancy = \"0.1 MPa\"\n";
  const Scenario rocks = read("[initial]\nstress_left = 0\nstress_right = 0\n" + rock +
                              "[domain]\nleft = \"-2 m\"\nright = \"2 m\"\n" + pores);
  const std::vector<std::string> names = rocks.friction.state_names();
  const auto column = std::find(names.begin(), names.end(), "dilatancy") - names.begin();
  const double end = rocks.domain.right.value();
  EXPECT_NEAR(state_at(rocks, -end)[static_cast<std::size_t>(column)], 0.1, 1e-12);
  EXPECT_NEAR(state_at(rocks, end)[static_cast<std::size_t>(column)], 0.1 / 3, 1e-12);
}

/// Neither a narrow patch nor one outside of an estimated domain is overlooked.
TEST(VaryingFrictionOfAScenario, VariesInPatches) {
  const std::string coulomb = "law = \"coulomb\"\ncoefficient = ";
  EXPECT_TRUE(read(step + domain + coulomb + "\"abs(x - 0.7003) < 1e-4 ? 0.5 : 0.3\"\n").friction.varies());
  const Scenario far = read(step + "[friction]\n" + coulomb + "\"x > 100 ? 0.5 : 0.3\"\n");
  ASSERT_TRUE(far.friction.varies());
  EXPECT_NEAR(far.friction.force(1, state_at(far, 200)), 0.5, 1e-12);
}

TEST(VaryingFrictionOfAScenario, TakesAConstantFormulaInSi) {
  const std::string text = "[initial]\nstress_left = 0\nstress_right = 0\n" + rock +
                           "[domain]\nleft = \"-2 m\"\nright = \"2 m\"\n[friction]\nlaw = \"coulomb\"\n";
  const Scenario number = read(text + "coefficient = \"10 kPa\"\n");
  const Scenario formula = read(text + "coefficient = \"1e4 + 0*x\"\nunits = \"SI\"\n");
  EXPECT_NEAR(formula.friction.parameter("coefficient"), number.friction.parameter("coefficient"), 1e-18);
  EXPECT_FALSE(formula.friction.varies());
}

TEST(VaryingFrictionOfAScenario, IsNoStressToCountIn) {
  const std::string text = "[initial]\nstress_left = \"0.5 sigma_N\"\nstress_right = 0\n" + rock +
                           "[domain]\nleft = \"-2 m\"\nright = \"2 m\"\n[friction]\nlaw = \"coulomb\"\nunits = \"SI\"\n"
                           "coefficient = 0.6\nnormal_stress = \"1e6*(2 + x/4)\"\n";
  EXPECT_EQ(refused(text).problem, "friction.normal_stress varies");
}

TEST(VaryingFrictionOfAScenario, ShowsItsRange) {
  std::vector<std::string> all;
  for (const Quantity& q : quantities_of(ageing + "direct_effect = \"0.02 + 0.005*x\"\n", "a.toml", {}))
    if (q.key.find("direct") != std::string::npos) all.push_back(q.key + " " + std::to_string(q.model));
  EXPECT_EQ(all, (std::vector<std::string>{"friction.direct_effect, least 0.010000",
                                           "friction.direct_effect, largest 0.030000"}));
}

}  // namespace
}  // namespace slipfront::scenario
