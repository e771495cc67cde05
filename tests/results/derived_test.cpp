#include <gtest/gtest.h>

#include <cmath>

#include "events/results/evaluate.hpp"
#include "slipfront/events/catalogue/read.hpp"

namespace {

using namespace slipfront;
using namespace slipfront::catalogue;
using Shape = MeasuredValue::Shape;

results::EventResult evaluated(const std::string& text) {
  results::EventResult result;
  results::EvaluationOptions options;
  options.sampling.samples = 0;
  read_csv(text, "t.csv", [&](Entry&& entry) { result = evaluate(std::move(entry), {}, options); });
  return result;
}

bool warns(const results::EventResult& result, std::string_view text) {
  for (const std::string& warning : result.warnings())
    if (warning.find(text) != std::string::npos) return true;
  return false;
}

TEST(Derived, SlipIsMomentOverModulusAndArea) {
  const auto r =
      evaluated("name,M0 (N m),Length (km),Width (km),Duration (days),shear_modulus\nA,3.6e18,60,40,20,30 GPa\n");
  EXPECT_DOUBLE_EQ(r.observation.slip->middle(), 3.6e18 / (30e9 * 60e3 * 40e3));
  EXPECT_TRUE(warns(r, "slip is moment / (shear_modulus rupture_length rupture_width)"));
  EXPECT_DOUBLE_EQ(r.observation.rupture_velocity_m_s->middle(), 60e3 / (20 * 86400));
  EXPECT_TRUE(warns(r, "apparent"));
}

TEST(Derived, TheErrorOfTheMagnitudeIsAFactorOfTheMoment) {
  const auto r = evaluated("name,Mw,Mw_err,Area (km2),Duration (s)\nA,7,0.1,2000,20\n");
  const MeasuredValue& slip = *r.observation.slip;
  EXPECT_EQ(slip.shape, Shape::lognormal);
  EXPECT_NEAR(slip.low, std::pow(10, 1.5 * 7 + 9.1) / (30e9 * 2e9), 1e-9);
  EXPECT_NEAR(slip.spread, std::pow(10, 0.15), 1e-12);
}

TEST(Derived, ErrorsOfLengthAndDurationAddInLn) {
  const auto r = evaluated("name,Length (km),Duration (days)\nA,60 */ 1.2,20 */ 1.3\n");
  const MeasuredValue& velocity = *r.observation.rupture_velocity_m_s;
  EXPECT_EQ(velocity.shape, Shape::lognormal);
  EXPECT_NEAR(std::log(velocity.spread), std::hypot(std::log(1.2), std::log(1.3)), 1e-12);
}

TEST(Derived, NothingReplacesAnObservationOrABound) {
  const auto r = evaluated("name,Vr (km/s),Length (km),Duration (s),Mw,Area (km2),slip (m)\nA,2.7,60,20,7,2000,1.5\n");
  EXPECT_DOUBLE_EQ(r.observation.rupture_velocity_m_s->middle(), 2700);
  EXPECT_DOUBLE_EQ(r.observation.slip->middle(), 1.5);
  EXPECT_FALSE(evaluated("name,Vr (km/s),Length (km),Duration (s)\nA,<2.7,60,30\n").observation.rupture_velocity_m_s);
  const auto fast = evaluated("name,Length (km),Duration (s),slip (m)\nA,600,20,1\n");
  EXPECT_FALSE(fast.observation.rupture_velocity_m_s);
  EXPECT_TRUE(warns(fast, "not below c"));
}

TEST(Derived, ALengthWithoutUnitIsNotUsed) {
  const TableNotes notes = read_csv("name,slip (m),length,duration (s)\nA,1,60,20\n", "t.csv", [](const Entry& entry) {
    EXPECT_FALSE(entry.error) << entry.error->problem;
    EXPECT_FALSE(entry.observation.rupture_length);
  });
  EXPECT_EQ(notes.notes, std::vector<std::string>{"t.csv:1: column 'length' has no unit: not used"});
}

}  // namespace
