#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "events/inference/sampling/proposal.hpp"
#include "events/inference/sampling/weighted_samples.hpp"
#include "slipfront/events/inference/estimate.hpp"
#include "slipfront/events/inference/posterior.hpp"
#include "slipfront/theory/medium/medium.hpp"
#include "slipfront/theory/rupture/relations.hpp"

namespace {

using slipfront::catalogue::RuptureVelocityIs;
using slipfront::catalogue::StressDropIs;
namespace sampled = slipfront::inference;

/// The quantiles of a Pareto distribution of shape k.
std::vector<double> pareto_quantiles(double k, int count) {
  std::vector<double> weights;
  for (int i = 0; i < count; ++i) weights.push_back(std::pow(1 - (i + 0.5) / count, -k));
  return weights;
}

/// The numbers come from a program in Python after Zhang & Stephens (2009) and Vehtari et al. (2024). With many weights
/// they tend to the shape.
TEST(ParetoK, AgreesWithAnotherProgram) {
  const double few[] = {0.3986942091452811, 0.5764101252763711, 0.7973444200990575};
  const double many[] = {0.31267306920261845, 0.6846435349864669, 1.1494952817464499};
  const double shapes[] = {0.3, 0.7, 1.2};
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_NEAR(sampled::pareto_k(pareto_quantiles(shapes[i], 60)), few[i], 1e-9);
    EXPECT_NEAR(sampled::pareto_k(pareto_quantiles(shapes[i], 4000)), many[i], 1e-9);
  }
}

/// Weights that equal the cutoff are not above it.
TEST(ParetoK, LeavesOutWeightsAtTheCutoff) {
  std::vector<double> weights = pareto_quantiles(0.7, 4000);
  const double cutoff = weights[4000 - 189 - 1];
  for (int i = 4000 - 189; i < 4000 - 189 + 60; ++i) weights[static_cast<std::size_t>(i)] = cutoff;
  EXPECT_NEAR(sampled::pareto_k(weights), 0.4190983990156295, 1e-9);
}

TEST(ParetoK, AllowsHeavierTailsForMoreWeights) {
  EXPECT_DOUBLE_EQ(sampled::most_pareto_k(100), 0.5);
  EXPECT_DOUBLE_EQ(sampled::most_pareto_k(1e6), 0.7);
}

/// The standard deviation of a range is its width over sqrt(12).
TEST(WeightedSamples, CountsTheDistanceFromARangeInItsStandardDeviations) {
  sampled::WeightedSamples samples;
  for (const double V : {1.0, 4.0}) {
    sampled::Sample s;
    s.weight = 1;
    s.state.rupture_velocity_m_s = V;
    samples.accepted = {s};
    const double expected = V < 2 ? std::sqrt(12.0) : -std::sqrt(12.0);
    EXPECT_DOUBLE_EQ(*samples.nearest_deviation({2, 3}, {}), expected);
  }
}

slipfront::catalogue::Observation observed_front() {
  slipfront::catalogue::Observation o;
  o.rupture_velocity_m_s = slipfront::catalogue::MeasuredValue{3000, 3000};
  return o;
}

/// The slowest front is that of the slowest pulse without friction.
TEST(PulseModel, SeesNoPulseBelowTheSlowestFront) {
  const sampled::PulseModel model(observed_front(), slipfront::friction::Closure::consistent);
  const double least = slipfront::friction_ratio::stress_range().least;
  const double expected =
      slipfront::rupture::from_stress(least).rupture_velocity *
      slipfront::friction_ratio::front_ratio(slipfront::friction::Closure::consistent, least, 0, 1e-3).value;
  EXPECT_NEAR(model.least_seen() / expected, 1, 1e-12);
  EXPECT_LT(model.most_u(0.999 * expected), 0);
  EXPECT_GE(model.most_u(1.001 * expected), 0);
}

TEST(PulseModel, SeesTheFastestPulseAtItsLargestStress) {
  for (const RuptureVelocityIs seen : {RuptureVelocityIs::front, RuptureVelocityIs::characteristic}) {
    slipfront::catalogue::Observation o = observed_front();
    o.rupture_velocity_is = seen;
    const sampled::PulseModel model(o, slipfront::friction::Closure::consistent);
    const double most = model.seen_without_friction(slipfront::friction_ratio::stress_range().most);
    EXPECT_NEAR(most / model.most_seen(), 1, 1e-12);
  }
}

/// The slope of the velocity by that of the observed front is that of neighbouring observations.
TEST(PulseModel, SlopeIsThatOfNeighbouringObservations) {
  const sampled::PulseModel model(observed_front(), slipfront::friction::Closure::consistent);
  constexpr double h = 1e-3;
  for (const double seen : {0.01, 0.1, 0.4, 0.6})
    for (const double share : {0.0, 0.2, 0.5}) {
      const double u = share * model.most_u(seen);
      const sampled::PulseState p = model.at(seen, u);
      EXPECT_NEAR(model.seen(p, u) / seen, 1, 1e-12);
      const double above = model.at(seen * std::exp(h), u).rupture_velocity,
                   below = model.at(seen * std::exp(-h), u).rupture_velocity;
      EXPECT_NEAR(p.slope, std::log(above / below) / (2 * h), h * h) << seen << " " << share;
    }
}

/// Far above the observed value, a normal error of 30 % counts as a factor of exp(0.3).
TEST(Evidence, CanExcludeValuesFarAboveThoseWithNormalErrors) {
  const auto likelihood = [](const slipfront::catalogue::MeasuredValue& m, double x, bool falls) {
    const sampled::Evidence e{sampled::Source::contact, "contact_ratio", m, 0.2};
    return e.blurred_likelihood(std::log(x), 0.4, falls);
  };
  const slipfront::catalogue::MeasuredValue normal{2, 2, slipfront::catalogue::MeasuredValue::Shape::normal, 0.6},
      lognormal{2, 2, slipfront::catalogue::MeasuredValue::Shape::lognormal, std::exp(0.3)};
  for (const double x : {10.0, 40.0, 200.0}) {
    EXPECT_NEAR(likelihood(normal, x, true) / likelihood(lognormal, x, true), 1, 1e-12) << x;
    EXPECT_GT(likelihood(normal, x, false), 0.05) << x;
  }
  for (const double x : {0.2, 1.5, 2.0}) EXPECT_EQ(likelihood(normal, x, true), likelihood(normal, x, false)) << x;
}

/// Without a blur, the likelihood of a value is that of the observation on either side.
TEST(Evidence, HasTheLikelihoodOfItsObservationOnEitherSide) {
  using slipfront::catalogue::MeasuredValue;
  for (const MeasuredValue& m : {MeasuredValue{2, 2, MeasuredValue::Shape::normal, 0.2},
                                 MeasuredValue{2, 2, MeasuredValue::Shape::split, 0.2, 0.4},
                                 MeasuredValue{2, 2, MeasuredValue::Shape::lognormal, 1.2}, MeasuredValue{1.9, 2.1}}) {
    const sampled::Evidence e{sampled::Source::contact, "contact_ratio", m, 0};
    for (const double x : {1.6, 1.95, 2.0, 2.05, 2.4})
      EXPECT_NEAR(e.blurred_likelihood(std::log(x), 0, false), m.likelihood(x), 1e-12) << x;
  }
}

/// A prediction that is uncertain by a factor of e^3 may be near the observed value.
TEST(Evidence, DoesNotExcludeSmallUncertainPredictions) {
  const slipfront::catalogue::MeasuredValue m{2, 2, slipfront::catalogue::MeasuredValue::Shape::normal, 0.2};
  const sampled::Evidence e{sampled::Source::contact, "contact_ratio", m, 0};
  EXPECT_GT(e.blurred_likelihood(std::log(1e-6), 3, false), 0.9);
  EXPECT_LT(e.blurred_likelihood(std::log(1e-6), 0.3, false), 1e-20);
}

/// The points of a cell are uniform, and their density is the share of the cell over its volume.
TEST(Cells, SpreadPointsUniformlyWithinEach) {
  using sampled::Axis;
  sampled::Cells cells(Axis::uniform(0, 2, 1), Axis::exact(7), Axis::uniform(1, 5, 2));
  cells.target(0, 0, 0) = 3;
  cells.target(0, 0, 1) = 1;
  cells.finish(0, {1}, {1, 1});
  for (const double p : {0.1, 0.3, 0.6, 0.9}) {
    const auto point = cells.at(p, 0.5, p);
    EXPECT_NEAR(point.first, 2 * p, 1e-12);
    EXPECT_EQ(point.second, 7);
    EXPECT_NEAR(point.third, p < 0.75 ? 1 + 2 * p / 0.75 : 3 + 2 * (p - 0.75) / 0.25, 1e-12);
    EXPECT_NEAR(point.density, p < 0.75 ? 0.75 / 4 : 0.25 / 4, 1e-12);
  }
}

TEST(WeightedSamples, FindTheDistanceOfTheNearestPrediction) {
  sampled::WeightedSamples samples;
  for (const double V : {2000.0, 2900.0, 2500.0}) {
    samples.accepted.push_back({1, sampled::unknown_state(), {}});
    samples.accepted.back().state.rupture_velocity_m_s = V;
  }
  const slipfront::catalogue::MeasuredValue normal{3000, 3000, slipfront::catalogue::MeasuredValue::Shape::normal, 50};
  EXPECT_NEAR(samples.nearest_deviation(normal, {}).value(), 2, 1e-12);
  EXPECT_FALSE(samples.nearest_deviation({3000, 3000}, {}));
}

/// Weights with a heavy tail determine a median, but no mean distance from it, unless the heavy samples are near it.
TEST(WeightedSamples, SufficeForAQuantityWhoseHeavySamplesAreNearItsMedian) {
  sampled::WeightedSamples samples;
  samples.drawn = 1000;
  for (const double weight : pareto_quantiles(1.5, 1000)) {
    samples.accepted.push_back({weight, sampled::unknown_state(), {}});
    samples.accepted.back().state.stress = std::exp(1 / weight);
    samples.accepted.back().state.contact_ratio = std::exp(0.1);
  }
  EXPECT_TRUE(samples.suffice_for(&sampled::FaultState::stress, 1));
  EXPECT_FALSE(samples.suffice_for(&sampled::FaultState::contact_ratio, 1));
}

TEST(WeightedSamples, AllCountIfTheirWeightsAreEqual) {
  slipfront::catalogue::Observation o = observed_front();
  o.rupture_velocity_is = RuptureVelocityIs::characteristic;
  o.slip_velocity_m_s = slipfront::catalogue::MeasuredValue{0.5, 0.5};
  sampled::Sampler sampler(o, {}, {.samples = 64});
  const sampled::WeightedSamples samples = sampled::draw_samples(sampler, 64, 64);
  EXPECT_EQ(samples.accepted.size(), 64u);
  EXPECT_NEAR(samples.effective, 64, 1e-9);
}

/// The other observations agree with a small part of this range of velocities. The cells move there.
TEST(Sampler, FindsTheVelocitiesOfAWideRangeThatAgreeWithTheOthers) {
  using slipfront::catalogue::MeasuredValue;
  slipfront::catalogue::Observation o;
  o.rupture_velocity_m_s = MeasuredValue{1, 3300};
  o.slip_velocity_m_s = MeasuredValue{0.5, 0.5, MeasuredValue::Shape::lognormal, 1.1};
  o.contact_ratio = 0.01;
  o.uncertain_constants = {
      {&slipfront::medium::Constants::contact_ratio, MeasuredValue{0.01, 0.01, MeasuredValue::Shape::lognormal, 1.1}}};
  for (const bool front : {false, true}) {
    o.rupture_velocity_is = front ? RuptureVelocityIs::front : RuptureVelocityIs::characteristic;
    sampled::Sampler sampler(o, {}, {.samples = 1000});
    EXPECT_GT(sampled::draw_samples(sampler, 1000, 1000).effective, front ? 350 : 200);
  }
}

/// An event that promises too few samples gets eight times the first ones, which may misjudge it.
TEST(WeightedSamples, GiveUpAnEventAfterEightTimesTheFirstSamples) {
  slipfront::catalogue::Observation o = observed_front();
  o.rupture_velocity_is = RuptureVelocityIs::characteristic;
  o.slip_velocity_m_s = slipfront::catalogue::MeasuredValue{0.4, 0.6};
  o.contact_ratio = 0.01;
  sampled::Sampler sampler(o, {}, {.samples = 16});
  EXPECT_EQ(sampled::draw_samples(sampler, 16, 4096, 1e6).drawn, 128u);
}

/// The misfit is the sum of the squared distances in standard deviations, at the state where it is least. Two values
/// that are n standard deviations apart have n^2 / 2. The cells, which have a width, find up to a third less.
TEST(Sampler, FindsTheLeastMisfitOfItsObservations) {
  using slipfront::catalogue::MeasuredValue;
  slipfront::catalogue::Observation o = observed_front();
  o.rupture_velocity_is = RuptureVelocityIs::characteristic;
  o.slip_velocity_m_s = MeasuredValue{0.5, 0.5};
  o.contact_ratio = 0.01;
  o.uncertain_constants = {
      {&slipfront::medium::Constants::contact_ratio, MeasuredValue{0.01, 0.01, MeasuredValue::Shape::lognormal, 1.1}}};
  o.hardness = MeasuredValue{1, 1};
  const double same = 0.01 / slipfront::medium::plastic_contact_ratio(0.25);
  const auto misfit = [&](double sigmas) {
    const double strength = same * std::pow(1.1, sigmas);
    o.normal_stress = MeasuredValue{strength, strength, MeasuredValue::Shape::lognormal, 1.1};
    return sampled::Sampler(o, {}, {}).least_misfit();
  };
  EXPECT_GE(misfit(0), 0);
  EXPECT_LT(misfit(0), 0.5);
  for (const double sigmas : {4.0, 6.0}) {
    EXPECT_LT(misfit(sigmas), sigmas * sigmas / 2) << sigmas;
    EXPECT_GT(misfit(sigmas), sigmas * sigmas / 3) << sigmas;
  }
}

TEST(Sampler, BoundsTheStressFromASlipVelocityAndTheContact) {
  using slipfront::catalogue::MeasuredValue;
  slipfront::catalogue::Observation o;
  o.slip_velocity_m_s = MeasuredValue{0.5, 0.5, MeasuredValue::Shape::lognormal, 1.2};
  o.contact_ratio = 0.01;
  const sampled::Sampler sampler(o, {}, {});
  EXPECT_TRUE(sampler.knows_contact());
  EXPECT_EQ(sampler.mode(), sampled::Mode::bounds);
}

TEST(PulseModel, TakesTheStaticDropOfAPulseWithoutFriction) {
  slipfront::catalogue::Observation o = observed_front();
  o.stress_drop = slipfront::catalogue::MeasuredValue{1e6, 1e6};
  const auto r = slipfront::rupture::from_rupture_velocity(0.4);
  for (const bool is_static : {true, false}) {
    o.stress_drop_is = is_static ? StressDropIs::static_drop : StressDropIs::stored;
    const sampled::PulseModel model(o, slipfront::friction::Closure::consistent);
    EXPECT_DOUBLE_EQ(model.without_friction(0.4).drop_share,
                     is_static ? (r.stress - r.stress_at_origin) / r.stress : 1.0);
  }
}

TEST(Estimate, TakesTheContactRatioFromTheStaticOrTheStoredDrop) {
  slipfront::catalogue::Observation o = observed_front();
  o.rupture_velocity_is = RuptureVelocityIs::characteristic;
  o.stress_drop = slipfront::catalogue::MeasuredValue{2e6, 2e6};
  for (const bool is_static : {true, false}) {
    o.stress_drop_is = is_static ? StressDropIs::static_drop : StressDropIs::stored;
    const sampled::Estimate e = sampled::estimate(o, {});
    const auto r = slipfront::rupture::from_rupture_velocity(3000 / e.speed);
    // The drop is A mu / pi times the change of the stress, which the closed form gives in units of mu A / pi.
    const double drop_per_A = 30e9 / std::acos(-1.0) * (is_static ? r.stress - r.stress_at_origin : r.stress);
    EXPECT_NEAR(e.contact_ratio->value * drop_per_A / 2e6, 1, 1e-12);
  }
}

/// An uncertain contact ratio above plastic contact counts where its distribution is below. An exact one is an error.
TEST(Estimate, WarnsIfOnlyTheErrorOfTheContactRatioIsInRange) {
  slipfront::catalogue::Observation o = observed_front();
  o.contact_ratio = 0.9;
  EXPECT_THROW((void)sampled::estimate(o, {}, true), slipfront::InputError);
  o.uncertain_constants.push_back(
      {&slipfront::medium::Constants::p_wave_speed, slipfront::catalogue::MeasuredValue{5900, 6100}});
  EXPECT_THROW((void)sampled::estimate(o, {}, true), slipfront::InputError);
  o.uncertain_constants = {
      {&slipfront::medium::Constants::contact_ratio,
       slipfront::catalogue::MeasuredValue{0.9, 0.9, slipfront::catalogue::MeasuredValue::Shape::lognormal, 2}}};
  const auto warnings = sampled::estimate(o, {}, true).warnings;
  EXPECT_TRUE(std::any_of(warnings.begin(), warnings.end(), [](const std::string& w) {
    return w.find("contact_ratio exceeds plastic contact") != std::string::npos;
  }));
}

TEST(Posterior, SamplesEventsWhoseObservationsNeedIt) {
  slipfront::catalogue::Observation o;
  EXPECT_FALSE(sampled::needs_samples(o));
  o.normal_stress = slipfront::catalogue::MeasuredValue{1e6, 1e6};
  EXPECT_FALSE(sampled::needs_samples(o));
  o.hardness = slipfront::catalogue::MeasuredValue{1e9, 1e9};
  EXPECT_TRUE(sampled::needs_samples(o));
  o.normal_stress.reset();
  EXPECT_FALSE(sampled::needs_samples(o));
  o.uncertain_constants.push_back({&slipfront::medium::Constants::p_wave_speed, {5900, 6100}});
  EXPECT_TRUE(sampled::needs_samples(o));
}

/// A front is slower than the characteristic velocity by an unknown factor, which exact velocities do not determine.
TEST(Posterior, SamplesExactVelocitiesIfOneIsThatOfTheFront) {
  slipfront::catalogue::Observation o = observed_front();
  EXPECT_FALSE(sampled::needs_samples(o));
  o.slip_velocity_m_s = slipfront::catalogue::MeasuredValue{0.5, 0.5};
  EXPECT_TRUE(sampled::needs_samples(o));
  o.rupture_velocity_is = RuptureVelocityIs::characteristic;
  EXPECT_FALSE(sampled::needs_samples(o));
}

TEST(Posterior, DerivesNoSlipVelocityThatWasNotObserved) {
  sampled::FaultState state = sampled::unknown_state();
  state.contact_ratio = 0.01;
  state.frictionless_slip_velocity = 2;
  sampled::derive(state, {.speed = 3000, .shear_modulus = 30e9, .poisson_ratio = 0.25}, {});
  EXPECT_TRUE(std::isnan(state.observed_slip_velocity));
  EXPECT_TRUE(std::isnan(state.slip_velocity_ratio));
}

/// A sample with a slower medium can have an observed velocity above c. It is rejected.
TEST(Posterior, RejectsSamplesFasterThanTheirMedium) {
  slipfront::catalogue::Observation o = observed_front();
  o.rupture_velocity_is = RuptureVelocityIs::characteristic;
  const double speed = slipfront::medium::speed_from_p_wave(6000, 0.25);
  o.rupture_velocity_m_s = slipfront::catalogue::MeasuredValue{0.9 * speed, 0.999 * speed};
  o.contact_ratio = 0.01;
  o.p_wave_speed = 6000;
  o.poisson_ratio = 0.25;
  o.uncertain_constants.push_back({&slipfront::medium::Constants::p_wave_speed, {5500, 6500}});
  const auto p = *sampled::posterior(o, {}, {.samples = 500});
  ASSERT_TRUE(p.rupture_velocity);
  EXPECT_LT(p.rupture_velocity->high, 1);
}

/// The friction coefficient is the damping number times b / (T c A), and as uncertain as b where all else is exact.
TEST(Posterior, DrawsSpacingsBelowAMetre) {
  slipfront::catalogue::Observation o = observed_front();
  o.rupture_velocity_is = RuptureVelocityIs::characteristic;
  o.slip_velocity_m_s = slipfront::catalogue::MeasuredValue{0.5, 0.5};
  o.contact_ratio = 0.01;
  o.duration = slipfront::catalogue::MeasuredValue{10, 10};
  o.asperity_spacing = 0.02;
  o.uncertain_constants = {{&slipfront::medium::Constants::asperity_spacing, {0.01, 0.03}}};
  const auto p = *sampled::posterior(o, {}, {.samples = 2000});
  ASSERT_TRUE(p.friction_coefficient && p.damping_number);
  EXPECT_NEAR(p.damping_number->high / p.damping_number->low, 1, 1e-9);
  const double per_spacing = p.damping_number->median / (10 * sampled::estimate(o, {}).speed * 0.01);
  EXPECT_NEAR(p.friction_coefficient->low / per_spacing, 0.011, 2e-4);
  EXPECT_NEAR(p.friction_coefficient->high / per_spacing, 0.029, 2e-4);
}

TEST(Posterior, DrawsPriorStatesWhoseVelocitiesAgree) {
  slipfront::catalogue::Observation o = observed_front();
  o.rupture_velocity_m_s = slipfront::catalogue::MeasuredValue{2900, 3100};
  o.slip_velocity_m_s = slipfront::catalogue::MeasuredValue{0.4, 0.6};
  o.contact_ratio = 0.01;
  const auto p = *sampled::posterior(o, {}, {.samples = 500, .draws = 20});
  ASSERT_EQ(p.prior_draws.size(), 20u);
  const double speed = sampled::estimate(o, {}).speed;
  for (const auto& s : p.prior_draws) EXPECT_NEAR(s.rupture_velocity_m_s / (s.rupture_velocity * speed), 1, 1e-12);
}

}  // namespace
