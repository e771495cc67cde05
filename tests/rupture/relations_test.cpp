#include "slipfront/theory/rupture/relations.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>
#include <numbers>

#include "error_metric.hpp"
#include "reference_table.hpp"
#include "slipfront/error.hpp"

namespace {

using slipfront::InputError;
using namespace slipfront::rupture;
using std::numbers::pi;

void expect_row(const Relations& r, const ReferenceRow& row, double condition) {
  const struct {
    const char* name;
    double value;
  } columns[] = {{"stress", r.stress},
                 {"rupture_velocity", r.rupture_velocity},
                 {"leading_velocity", r.leading_velocity},
                 {"velocity_ratio", r.velocity_ratio},
                 {"slip_velocity", r.slip_velocity},
                 {"stress_at_origin", r.stress_at_origin},
                 {"dislocation_velocity_at_origin", r.dislocation_velocity_at_origin},
                 {"psi", r.psi},
                 {"psi_at_origin", r.psi_at_origin}};
  for (const auto& c : columns)
    EXPECT_LE(error_in_eps(c.value, row[c.name]), 16 * condition)
        << c.name << " at stress " << row.text("stress") << ", V " << row.text("rupture_velocity");
}

TEST(Relations, MatchTheTableFromRuptureVelocity) {
  for (const auto& row : reference_table("relations_from_velocity.csv"))
    expect_row(from_rupture_velocity(row["rupture_velocity"]), row, std::fmax(1, 1 / (1 - row["rupture_velocity"])));
}

TEST(Relations, MatchTheTableFromStress) {
  for (const auto& row : reference_table("relations_from_stress.csv"))
    expect_row(from_stress(row["stress"]), row, std::fmax(1, pi / row["stress"]));
}

TEST(Relations, MatchTheTableFromSlipVelocity) {
  for (const auto& row : reference_table("relations_from_slip_velocity.csv"))
    expect_row(from_slip_velocity(row["slip_velocity"]), row, 1);
}

/// The two worked examples of the paper without friction (docs/worked_examples.md), and the stress of its figures.
TEST(Relations, ReproduceTheNumbersOfThePaper) {
  EXPECT_NEAR(from_rupture_velocity(0.55).stress, 1.03653, 5e-6);
  EXPECT_NEAR(from_stress(1.03).rupture_velocity, 0.54390, 5e-6);
  EXPECT_NEAR(from_stress(1.03).slip_velocity, 0.1000039, 5e-8);
  EXPECT_NEAR(from_rupture_velocity(2.14e-5).stress, 0.21176, 5e-6);
  EXPECT_NEAR(from_stress(0.213).slip_velocity, 2.645e-7, 5e-11);
  EXPECT_NEAR(from_rupture_velocity(2.14e-5).slip_velocity, 2.415e-7, 5e-11);
  EXPECT_NEAR(from_stress(0.855).slip_velocity, 0.0482084, 5e-8);
}

// Round trips lose what the conditioning of the way back costs, and no more.
RC_GTEST_PROP(Relations, RoundTripThroughStress, ()) {
  const double exponent = *rc::gen::inRange(-300000, 0) / 1000.0;
  const double V = std::pow(10.0, exponent) * 0.9999;
  const Relations there = from_rupture_velocity(V);
  const double condition = std::fmax(1, pi / there.stress) / (1 - V);
  RC_ASSERT(error_in_eps(from_stress(there.stress).rupture_velocity, V) <= 16 * condition);
}

RC_GTEST_PROP(Relations, RoundTripThroughSlipVelocity, ()) {
  const double exponent = *rc::gen::inRange(-300000, 0) / 1000.0;
  const double V = std::pow(10.0, exponent) * 0.9999;
  const Relations there = from_rupture_velocity(V);
  RC_ASSERT(error_in_eps(from_slip_velocity(there.slip_velocity).rupture_velocity, V) <= 32 / (1 - V));
}

RC_GTEST_PROP(Relations, IncreaseTogether, ()) {
  const double a = 0.0046 * std::exp(*rc::gen::inRange(0, 12000) / 1000.0);
  const double b = a * (1 + *rc::gen::inRange(1, 1000) * 1e-4);
  const Relations low = from_stress(a), high = from_stress(b);
  RC_ASSERT(low.psi < high.psi);
  RC_ASSERT(low.psi_at_origin < high.psi_at_origin);
  RC_ASSERT(low.slip_velocity < high.slip_velocity);
  RC_ASSERT(low.stress_at_origin < high.stress_at_origin);
  RC_ASSERT(low.rupture_velocity <= high.rupture_velocity);
  RC_ASSERT(low.velocity_ratio >= high.velocity_ratio);
  RC_ASSERT(low.stress_at_origin < low.stress);
  RC_ASSERT(low.leading_velocity <= low.rupture_velocity);
}

TEST(Relations, ApproachTheirLimits) {
  const Relations slow = from_rupture_velocity(1e-200);  // Sigma = pi / ln(4 / psi), W(0) = pi psi0
  EXPECT_NEAR(slow.stress * std::log(4 / slow.psi) / pi, 1, 1e-14);
  EXPECT_NEAR(slow.slip_velocity / (pi * slow.psi_at_origin), 1, 1e-14);
  const Relations fast = from_stress(1e6);  // dense: Sigma = 2 cosh psi, sound at 2 psi + ln(2) / 2
  EXPECT_NEAR(fast.psi, std::log(1e6), 1e-12);
  EXPECT_NEAR(fast.psi_at_origin, (std::log(1e6) - 0.5 * std::log(2.0)) / 3, 1e-6);
  EXPECT_NEAR(fast.velocity_ratio, 1, 1e-11);
}

TEST(Relations, WorkToTheEndsOfTheirRanges) {
  for (const double s : {0.00447, 1e308}) EXPECT_TRUE(std::isfinite(from_stress(s).slip_velocity)) << s;
  for (const double v : {2e-302, 1 - 0x1p-53}) EXPECT_GE(from_rupture_velocity(v).psi_at_origin, DBL_MIN) << v;
  for (const double w : {7.2e-308, 5e307}) EXPECT_TRUE(std::isfinite(from_slip_velocity(w).stress)) << w;
}

TEST(Relations, RejectValuesThatNoPulseHas) {
  for (const double bad : {0.0, -1.0, 1e-3, std::nan(""), HUGE_VAL}) {
    EXPECT_THROW(from_stress(bad), InputError) << bad;
    if (bad != 1e-3) {
      EXPECT_THROW(from_rupture_velocity(bad), InputError) << bad;
    }
    if (bad != 1e-3) {
      EXPECT_THROW(from_slip_velocity(bad), InputError) << bad;
    }
  }
  EXPECT_THROW(from_rupture_velocity(1), InputError);
  try {
    from_rupture_velocity(1.5);
    FAIL();
  } catch (const InputError& error) {
    EXPECT_EQ(error.complaint().key, "rupture_velocity");
    EXPECT_EQ(error.complaint().value, "1.5");
  }
}

}  // namespace
