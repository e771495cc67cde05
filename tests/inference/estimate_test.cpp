#include "slipfront/events/inference/estimate.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <numbers>
#include <sstream>

#include "folders.hpp"
#include "slipfront/error.hpp"
#include "slipfront/events/catalogue/read.hpp"
#include "slipfront/theory/rupture/relations.hpp"

namespace {

using namespace slipfront;
using namespace slipfront::catalogue;
using namespace slipfront::inference;
using std::numbers::pi;

Observation from_case(const std::string& name) {
  std::ifstream file(std::string(cases_folder) + "/" + name);
  std::ostringstream text;
  text << file.rdbuf();
  return read_toml(text.str(), name);
}

bool mentions(const std::vector<std::string>& warnings, const std::string& word) {
  for (const std::string& w : warnings)
    if (w.find(word) != std::string::npos) return true;
  return false;
}

/// The values are the rows without friction in docs/worked_examples.md. The paper uses rounded c, V and Sigma-, and so
/// does the second half of this test.
TEST(Estimate, ReproducesParkfield) {
  const Estimate e = estimate(from_case("parkfield-2004.toml"), {});
  EXPECT_NEAR(e.speed, 5421.0, 0.05);
  EXPECT_NEAR(e.rupture_velocity->value, 0.5534, 5e-5);
  const double W = rupture::from_rupture_velocity(e.rupture_velocity->value).slip_velocity;
  EXPECT_NEAR(e.contact_ratio->value, pi * 0.5 / (e.speed * W), 1e-15);
  EXPECT_FALSE(e.stress_pa);  // only a bound is known
  EXPECT_EQ(e.contact_ratio_bound->value, e.contact_ratio->value);
  EXPECT_NEAR(e.stress_pa_bound->value, 30e9 * e.contact_ratio->value * e.stress->value / pi, 1);
  EXPECT_FALSE(e.observed_slip_velocity);  // without an independent A it would only repeat the frictionless value
  const double paper_A = pi * 0.5 / (5400 * rupture::from_stress(1.03).slip_velocity);
  EXPECT_NEAR(paper_A, 0.0029, 5e-5);
  EXPECT_NEAR(30e9 * paper_A * 1.03 / pi / 1e6, 29, 0.5);
}

TEST(Estimate, ReproducesEpisodicTremorAndSlip) {
  const Estimate e = estimate(from_case("ets.toml"), {});
  EXPECT_NEAR(e.rupture_velocity->value, 2.135e-5, 5e-9);
  EXPECT_NEAR(e.observed_slip_velocity->value, 4.8e-8, 5e-10);
  EXPECT_NEAR(e.slip_velocity_ratio->value, e.observed_slip_velocity->value / e.frictionless_slip_velocity->value,
              1e-15);
  EXPECT_EQ(e.contact_ratio->value, 4e-5);
}

TEST(Estimate, TurnsRangesIntoExactQuantiles) {
  Observation o;
  o.rupture_velocity_m_s = MeasuredValue{1000, 3000};
  o.slip_velocity_m_s = MeasuredValue{0.5, 0.5};
  const Estimate e = estimate(o, {});
  const auto at = [&](double V) { return rupture::from_rupture_velocity(V / e.speed); };
  EXPECT_DOUBLE_EQ(e.rupture_velocity->value, 2000 / e.speed);
  EXPECT_DOUBLE_EQ(e.stress->interval->low, at(1100).stress);
  EXPECT_DOUBLE_EQ(e.stress->interval->high, at(2900).stress);
  EXPECT_DOUBLE_EQ(e.contact_ratio->interval->low, pi * 0.5 / (e.speed * at(2900).slip_velocity));
  o.slip_velocity_m_s = MeasuredValue{0.4, 0.6};
  const Estimate both = estimate(o, {});
  EXPECT_DOUBLE_EQ(both.stress->interval->low, at(1100).stress);  // depends only on the rupture velocity
  EXPECT_FALSE(both.contact_ratio->interval);                     // depends on both
  EXPECT_TRUE(mentions(both.warnings, "several observed errors change"));
}

TEST(Estimate, WarnsOfAssumedConstants) {
  Observation o;
  o.rupture_velocity_m_s = MeasuredValue{3000, 3000};
  EXPECT_TRUE(mentions(estimate(o, {}).warnings, "assumed: poisson_ratio 0.3, p_wave_speed 6000 m/s"));
  medium::Defaults stated;
  stated.stated_speed = stated.stated_poisson = stated.stated_modulus = true;
  EXPECT_FALSE(mentions(estimate(o, stated).warnings, "assumed"));
  o.s_wave_speed = 3500;
  o.poisson_ratio = 0.25;
  o.density = 2700;
  const Estimate e = estimate(o, {});
  EXPECT_FALSE(mentions(e.warnings, "assumed"));
  EXPECT_NEAR(e.speed, 3500 * std::sqrt(2 / 0.75), 1e-9);
}

TEST(Estimate, LeavesUnidentifiableQuantitiesAbsent) {
  Observation o;
  o.slip_velocity_m_s = MeasuredValue{0.5, 0.5};
  const Estimate none = estimate(o, {});
  EXPECT_FALSE(none.stress);
  EXPECT_FALSE(none.contact_ratio);
  EXPECT_TRUE(mentions(none.warnings, "not identifiable"));
  o.contact_ratio = 0.003;
  const Estimate by_slip = estimate(o, {});
  EXPECT_DOUBLE_EQ(by_slip.stress->value, rupture::from_slip_velocity(by_slip.observed_slip_velocity->value).stress);
  EXPECT_FALSE(by_slip.rupture_velocity);
}

TEST(Estimate, RejectsUnphysicalObservations) {
  Observation o;
  o.file = "f.csv";
  o.line = 7;
  o.rupture_velocity_m_s = MeasuredValue{6000, 6000};
  try {
    estimate(o, {});
    FAIL();
  } catch (const InputError& error) {
    EXPECT_EQ(error.complaint().key, "rupture_velocity");
    EXPECT_EQ(error.complaint().line, 7u);
    EXPECT_NE(error.complaint().allowed.find("5421.05"), std::string::npos);
  }
  o.rupture_velocity_m_s = MeasuredValue{3000, 3000};
  o.poisson_ratio = 0.5;
  EXPECT_THROW(estimate(o, {}), InputError);
  o.poisson_ratio = 0.25;
  o.contact_ratio = 0.9;  // above plastic contact
  EXPECT_THROW(estimate(o, {}), InputError);
}

TEST(Estimate, WarnsOfAContactRatioAbovePlastic) {
  Observation o;
  o.rupture_velocity_m_s = MeasuredValue{0.1, 0.1};
  o.slip_velocity_m_s = MeasuredValue{0.1, 0.1};
  EXPECT_TRUE(mentions(estimate(o, {}).warnings, "exceeds plastic contact"));
}

TEST(Estimate, KeepsNumbersFiniteForAbsurdSlip) {  // found by fuzzing an .fsp file
  Observation o = from_case("parkfield-2004.toml");
  o.slip_velocity_m_s = MeasuredValue{1e305, 1e305};
  const Estimate e = estimate(o, {});
  EXPECT_FALSE(e.stress_pa);
  EXPECT_TRUE(e.stress);
}

}  // namespace
