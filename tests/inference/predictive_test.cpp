#include <gtest/gtest.h>

#include <cmath>

#include "slipfront/events/inference/estimate.hpp"
#include "slipfront/events/inference/posterior.hpp"

namespace {

using namespace slipfront::catalogue;
using namespace slipfront::inference;
using Shape = MeasuredValue::Shape;

constexpr double one_sigma = 0.8413447460685429;  // share of a normal distribution below one standard deviation

TEST(Predictive, RepeatsAnObservationWithItsError) {
  EXPECT_EQ(repeated({3, 3}, 5, 0.9), 5);
  EXPECT_NEAR(repeated({3, 3, Shape::normal, 0.5}, 5, one_sigma), 5.5, 1e-12);
  EXPECT_NEAR(repeated({3, 3, Shape::lognormal, 1.5}, 5, 1 - one_sigma), 5 / 1.5, 1e-12);
  EXPECT_NEAR(repeated({2, 4}, 5, 0.75), 5.5, 1e-12);
}

/// The value 3 +0.3/-0.1 allows a true value that is smaller by 0.1. It is then above the true value by 0.1.
TEST(Predictive, RepeatsUnequalErrorsOnTheirSides) {
  const MeasuredValue unequal{3, 3, Shape::split, 0.3, 0.1};
  EXPECT_NEAR(repeated(unequal, 5, one_sigma), 5.1, 1e-12);
  EXPECT_NEAR(repeated(unequal, 5, 1 - one_sigma), 4.7, 1e-12);
  EXPECT_NEAR(repeated(unequal, 5, 0.5), 5, 1e-12);
  for (const double share : {0.01, 0.05, 0.3})
    EXPECT_NEAR((repeated(unequal, 5, 0.5 + share) - 5) / 0.1, (5 - repeated(unequal, 5, 0.5 - share)) / 0.3, 1e-12);
}

/// The share of repeated observations below the observed one is the posterior predictive check.
TEST(Predictive, AgreesWithThePredictiveCheck) {
  Observation o;
  o.rupture_velocity_m_s = MeasuredValue{2700, 2700, Shape::normal, 300};
  o.slip_velocity_m_s = MeasuredValue{0.5, 0.5, Shape::lognormal, 1.5};
  o.stress_drop = MeasuredValue{5e6, 5e6, Shape::lognormal, 1.5};
  const auto p = posterior(o, {}, {.draws = 4000});
  ASSERT_TRUE(p && p->suffices);
  ASSERT_EQ(p->predictions.size(), 3u);
  ASSERT_EQ(p->repeated.size(), 4000u);
  const ObservedValues observed = observed_values(o);
  for (const Prediction& check : p->predictions) {
    const std::size_t i = position_of(check.observation);
    double below = 0;
    for (const ObservedValues& values : p->repeated) below += values[i] < observed[i];
    EXPECT_NEAR(below / 4000, check.below, 0.03) << check.observation;
  }
}

TEST(Predictive, DrawsAsManyStatesFromThePrior) {
  Observation o;
  o.rupture_velocity_m_s = MeasuredValue{2700, 2700, Shape::normal, 300};
  o.slip = MeasuredValue{1, 1, Shape::lognormal, 1.5};
  o.duration = MeasuredValue{3, 3, Shape::normal, 1.5};  // one in 44 of its quantiles is negative
  const auto p = posterior(o, {}, {.draws = 500});
  ASSERT_TRUE(p && p->suffices);
  ASSERT_EQ(p->prior_draws.size(), 500u);
  for (const FaultState& s : p->prior_draws) {
    EXPECT_TRUE(s.contact_ratio >= least_contact_ratio && s.contact_ratio < 1);
    EXPECT_TRUE(s.damping_number >= 0 && s.damping_number <= most_damping_number);
    EXPECT_LE(s.rupture_velocity, s.characteristic_velocity);
  }
}

}  // namespace
