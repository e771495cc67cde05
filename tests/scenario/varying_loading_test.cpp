// Springs that vary along the chain: by formulas, and by tables.

#include <gtest/gtest.h>

#include <string>

#include "slipfront/error.hpp"
#include "slipfront/scenario/problem.hpp"
#include "slipfront/scenario/quantities.hpp"
#include "support.hpp"

namespace slipfront::scenario {
namespace {

const std::string loaded =
    "[initial]\nstress_left = 0\nstress_right = 0\n[domain]\nleft = -2\nright = 2\n[loading]\nvelocity = 0.2\n";

TEST(VaryingLoadingOfAScenario, IsAFormulaOfX) {
  const std::string text = loaded + "stiffness = \"0.3 + 0.1*x\"\n[chain]\nscale = 10\n";
  const Scenario s = read(text, {"loading.velocity=-0.1*(3 + x)"});
  EXPECT_NEAR(s.loading.stiffness, 0.5, 1e-15);
  EXPECT_NEAR(s.loading.velocity, -0.5, 1e-15);
  EXPECT_NEAR(s.loading.event_velocity, 5, 1e-14);
  const chain::Problem p = chain::problem_of(chain_problem(s));
  EXPECT_NEAR(p.loading.stiffness_of(10), 0.4 / 100, 1e-16);
  EXPECT_NEAR(p.loading.velocity_of(10), -0.4, 1e-15);
}

TEST(VaryingLoadingOfAScenario, IsAColumnOfATable) {
  const std::string text = loaded + "stiffness = { file = \"k.csv\", column = \"k\" }\n";
  const Scenario s = read(text, {}, {{-2, 0}, {0, 0}, {2, 0.4}});
  EXPECT_EQ(s.loading.stiffness_of(-1), 0);  // no springs there
  EXPECT_NEAR(s.loading.stiffness_of(1), 0.2, 1e-15);
  EXPECT_TRUE(contains(refused(text, {}, {{-2, 0.1}, {0, -0.1}, {2, 0.4}}).problem, "row 2: k = -0.1"));
  EXPECT_TRUE(contains(refused(text, {}, {{-2, 0.1}, {1, 0.4}}).problem, "no value at x = 1.0"));
  EXPECT_EQ(files_of(s), (std::vector<std::string>{"dir/s.toml", "dir/k.csv"}));
}

TEST(VaryingLoadingOfAScenario, IsANumberIfTheFormulaIs) {
  const Scenario s = read(loaded + "where = \"left\"\nstiffness = \"0.3 + 0*x\"\n");
  EXPECT_FALSE(s.loading.stiffness_at);
  EXPECT_EQ(s.loading.stiffness, 0.3);
}

TEST(VaryingLoadingOfAScenario, NamesThePositionOfAValueThatIsNotAllowed) {
  const Complaint negative = refused(loaded + "stiffness = \"0.1*x\"\n");
  EXPECT_EQ(negative.key, "loading.stiffness");
  EXPECT_TRUE(contains(negative.problem, "is -0.2 at x = -2")) << negative.problem;
  EXPECT_EQ(negative.allowed, "a finite number >= 0");
  EXPECT_EQ(refused(loaded + "stiffness = \"0*x\"\n").problem, "is 0 everywhere");
  const std::string springs = loaded + "stiffness = 0.1\n";
  EXPECT_TRUE(contains(refused(springs, {"loading.velocity=1/(x + 2)"}).problem, "inf at x = -2"));
  const Complaint end = refused(springs, {"loading.velocity=0.1*x", "loading.where=left"});
  EXPECT_EQ(end.problem, "varies, but the springs pull one end only");
  EXPECT_TRUE(contains(refused(loaded + "stiffness = \"1 + x/9\"\narea = \"1 m2\"\n").problem, "varies"));
}

TEST(VaryingLoadingOfAScenario, IsInSiWithItsUnits) {
  const std::string text =
      "[initial]\nstress_left = 0\nstress_right = 0\n[medium]\nshear_modulus = \"30 GPa\"\ndensity = \"2700 kg/m3\"\n"
      "poisson_ratio = 0.25\ncontact_ratio = 0.01\nasperity_spacing = \"1 mm\"\n[domain]\nleft = \"-2 m\"\n"
      "right = \"2 m\"\n[loading]\nvelocity = \"1 um/s\"\nstiffness = ";
  const Scenario number = read(text + "\"2 MPa/mm\"\n"), varies = read(text + "\"1e9*(1.5 + x/4)\"\nunits = \"SI\"\n");
  EXPECT_NEAR(varies.loading.stiffness / number.loading.stiffness, 1, 1e-12);
  EXPECT_NEAR(varies.loading.stiffness_of(0) / number.loading.stiffness, 0.75, 1e-12);
  EXPECT_TRUE(contains(refused(text + "\"1e9*(1.5 + x/4)\"\n").problem, "no units are given"));
}

TEST(VaryingLoadingOfAScenario, ShowsItsRange) {
  std::vector<std::string> all;
  for (const Quantity& q : quantities_of(loaded + "stiffness = \"0.3 + 0.1*x\"\n", "a.toml", {}))
    if (contains(q.key, "loading")) all.push_back(q.key + " " + std::to_string(q.model));
  EXPECT_EQ(all, (std::vector<std::string>{"loading.stiffness, least 0.100000", "loading.stiffness, largest 0.500000",
                                           "loading.velocity 0.200000"}));
}

}  // namespace
}  // namespace slipfront::scenario
