/// Each event has one answer: a median with its interval, or a bound that is marked as a bound (docs/events.md).
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>
#include <string>
#include <vector>

#include "events/finite_fault/on_plane.hpp"
#include "events/inference/sampling/weighted_samples.hpp"
#include "events/results/columns.hpp"
#include "events/results/evaluate.hpp"
#include "slipfront/events/catalogue/read.hpp"
#include "slipfront/theory/rupture/relations.hpp"

namespace {

using namespace slipfront;
using namespace slipfront::catalogue;
using namespace slipfront::inference;
using namespace slipfront::finite_fault;
using namespace slipfront::results;

EventResult result_of(const std::string& toml, const EvaluationOptions& plan = {}) {
  return evaluate({.observation = read_toml(toml, "a.toml"), .error = {}}, {}, plan);
}

bool mentions(const EventResult& result, const std::string& words) {
  for (const std::string& w : result.warnings())
    if (w.find(words) != std::string::npos) return true;
  return false;
}

std::string tohoku(const char* slip, const char* rise, const char* modulus) {
  return std::string(
             "[event]\nname = \"Tohoku 2011\"\nrupture_velocity = \"2.0 +- 0.4 km/s\"\n"
             "rupture_velocity_is = \"characteristic\"\nslip = \"") +
         slip + "\"\nrise_time = \"" + rise + "\"\n[medium]\nshear_modulus = \"" + modulus + "\"\n";
}

double width(const EventResult& r) {
  const auto& i = r.estimate->stress_pa_bound->interval;
  return i ? std::log(i->high / i->low) : 0;
}

/// Computes the distribution of the bound with another sampler: plain Monte Carlo over the observed quantities, with a
/// uniform prior in ln V and the likelihood of a normal error.
TEST(Answer, IncludesEveryErrorInTheBoundOfTohoku) {
  const EventResult r = result_of(tohoku("12 */ 1.5 m", "40 */ 1.4 s", "40 GPa"), {.sampling = {.samples = 20000}});
  ASSERT_TRUE(r.estimate) << r.error;
  EXPECT_FALSE(r.estimate->stress_pa);
  EXPECT_FALSE(r.posterior->stress_pa || r.posterior->damping_number);
  std::mt19937_64 bits(1);
  std::normal_distribution<double> normal;
  std::vector<std::pair<double, double>> values;
  double total = 0;
  for (int n = 0; n < 200000; ++n) {
    const double V = 2000 + 400 * normal(bits);
    const double w = 12 / 40.0 * std::exp(std::log(1.5) * normal(bits) - std::log(1.4) * normal(bits));
    if (!(V > 0 && V < r.estimate->speed)) continue;
    const auto closed = rupture::from_rupture_velocity(V / r.estimate->speed);
    const double weight = std::min(1.0, V / (MeasuredValue::least_even_share * 2000)) / V;
    values.emplace_back(40e9 * closed.stress * w / (r.estimate->speed * closed.slip_velocity), weight);
    total += weight;
  }
  std::sort(values.begin(), values.end());
  double below = 0;
  std::vector<double> wanted;
  for (const auto& [value, weight] : values) {
    below += weight;
    if (wanted.size() < 3 && below >= total * (wanted.empty() ? 0.05 : wanted.size() == 1 ? 0.5 : 0.95))
      wanted.push_back(value);
  }
  const Inferred& bound = *r.estimate->stress_pa_bound;
  EXPECT_NEAR(bound.interval->low / wanted[0], 1, 0.02);
  EXPECT_NEAR(bound.value / wanted[1], 1, 0.02);
  EXPECT_NEAR(bound.interval->high / wanted[2], 1, 0.02);
  EXPECT_NEAR(bound.value / 40e6, 1, 0.1);

  const double all = width(r), of_V = width(result_of(tohoku("12 m", "40 s", "40 GPa")));
  EXPECT_GT(of_V, 0.5);
  EXPECT_GT(width(result_of(tohoku("12 */ 1.5 m", "40 s", "40 GPa"))), 1.1 * of_V);
  EXPECT_GT(width(result_of(tohoku("12 m", "40 */ 1.4 s", "40 GPa"))), 1.05 * of_V);
  EXPECT_GT(width(result_of(tohoku("12 m", "40 s", "40 */ 1.4 GPa"))), 1.05 * of_V);
  EXPECT_GT(all, 1.1 * of_V);
}

/// JSON, CSV, NetCDF and Python hold each answer twice, in estimate and posterior. Both must be equal.
TEST(Answer, AgreesWithThePosterior) {
  const EventResult r = result_of(
      "[event]\nrupture_velocity = \"3.0 +- 0.2 km/s\"\nslip_velocity = \"0.5 */ 1.2 m/s\"\n[medium]\ncontact_ratio = "
      "{ mean = 0.01, sd = 0.002 }\n");
  ASSERT_TRUE(r.estimate) << r.error;
  const Estimate& e = *r.estimate;
  EXPECT_EQ(e.stress->value, r.posterior->stress->median);
  EXPECT_EQ(e.stress_pa->interval->high, r.posterior->stress_pa->high);
  EXPECT_EQ(e.damping_number->interval->low, r.posterior->damping_number->low);
  EXPECT_TRUE(e.slip_velocity_ratio->interval && e.observed_slip_velocity->interval && e.rupture_velocity->interval);
  EXPECT_FALSE(e.stress_pa_bound || e.contact_ratio_bound);
  // The medians of quantities that depend only on |V-| satisfy the closed form.
  EXPECT_NEAR(rupture::from_rupture_velocity(e.characteristic_velocity->value).stress, e.stress->value, 1e-5);
}

/// The column of a file with this name, for one event.
double in_file(const EventResult& r, const std::string& name) {
  for (const NumberColumn& c : number_columns({.pulse = false, .draws = 0}))
    if (c.name == name) {
      double value = 0;
      c.get(r, &value);
      return value;
    }
  ADD_FAILURE() << "no column " << name;
  return 0;
}

TEST(Answer, WritesTheShareOfThePriorToFiles) {
  const std::string velocities =
      "[event]\nrupture_velocity = \"3.0 +- 0.2 km/s\"\nslip_velocity = \"0.5 */ 1.2 m/s\"\n";
  const EventResult known = result_of(velocities + "[medium]\ncontact_ratio = { mean = 0.01, sd = 0.002 }\n");
  ASSERT_TRUE(known.posterior && known.posterior->contact_ratio_prior_share) << known.error;
  EXPECT_EQ(in_file(known, "contact_ratio_prior_share"), *known.posterior->contact_ratio_prior_share);
  EXPECT_EQ(in_file(known, "damping_number_prior_share"), *known.posterior->damping_number_prior_share);
  EXPECT_LT(in_file(known, "contact_ratio_prior_share"), 0.2);
  // The velocities only bound both quantities.
  const EventResult bound = result_of(velocities + "rupture_velocity_is = \"characteristic\"\n");
  EXPECT_EQ(in_file(bound, "contact_ratio_prior_share"), 1);
  EXPECT_EQ(in_file(bound, "damping_number_prior_share"), 1);
  const EventResult none = result_of("[event]\nrupture_velocity = \"3 km/s\"\n");
  EXPECT_TRUE(std::isnan(in_file(none, "contact_ratio_prior_share")));
}

TEST(Answer, BoundsTheStressWithoutARuptureVelocity) {
  const EventResult r = result_of(
      "[event]\nslip_velocity = \"0.5 */ 1.3 m/s\"\n[medium]\ncontact_ratio = { median = 0.003, factor = 1.2 }\n");
  ASSERT_TRUE(r.estimate) << r.error;
  EXPECT_FALSE(r.estimate->stress_pa);
  ASSERT_TRUE(r.estimate->stress_bound && r.estimate->stress_pa_bound);
  EXPECT_TRUE(r.estimate->stress_bound->interval && r.estimate->stress_pa_bound->interval);
  EXPECT_EQ(r.estimate->stress_bound->value, r.estimate->stress->value);
}

/// The closed forms ignore this rupture velocity, because it reaches above c, and the samples use its part below c.
TEST(Answer, HasNoBoundOfTheStressIfSamplesYieldIt) {
  const EventResult r = result_of(
      "[event]\nrupture_velocity = \"5..8 km/s\"\nslip_velocity = \"0.5 m/s\"\n[medium]\ncontact_ratio = { median = "
      "0.01, factor = 2 }\n");
  ASSERT_TRUE(r.estimate && r.posterior && r.posterior->stress) << r.error;
  EXPECT_EQ(r.estimate->stress->value, r.posterior->stress->median);
  EXPECT_FALSE(r.estimate->stress_bound || r.estimate->stress_pa_bound || r.estimate->contact_ratio_bound);
}

TEST(Answer, UsesThePartOfAVelocityBelowC) {
  // V is two standard deviations above c, so a few per cent of the samples are below c.
  const EventResult r = result_of("[event]\nrupture_velocity = \"6.0 +- 0.3 km/s\"\nslip_velocity = \"0.5 m/s\"\n");
  ASSERT_TRUE(r.estimate) << r.error;
  EXPECT_GE(r.posterior->effective_samples, least_effective_samples);
  EXPECT_LT(r.estimate->rupture_velocity->interval->high, 1);
  EXPECT_TRUE(mentions(r, "not below the speed c"));
  EXPECT_NE(result_of("[event]\nrupture_velocity = \"9.0 +- 0.3 km/s\"\n").error, "");  // twelve deviations
  EXPECT_NE(result_of("[event]\nrupture_velocity = \"6.0 km/s\"\n").error, "");
}

TEST(Answer, SamplesAContactAbovePlasticIfItsErrorReachesBelow) {
  // Without friction this slip velocity needs a contact ratio of 0.35.
  const std::string head = "[event]\nrupture_velocity = \"3 km/s\"\nslip_velocity = \"30 m/s\"\n[medium]\n";
  const EventResult r = result_of(head + "contact_ratio = { median = 0.7, factor = 1.5 }\n");
  ASSERT_TRUE(r.estimate && r.estimate->contact_ratio && r.estimate->contact_ratio->interval) << r.error;
  EXPECT_LT(r.estimate->contact_ratio->interval->high, 0.592);
  EXPECT_TRUE(mentions(r, "exceeds plastic contact"));
  EXPECT_NE(result_of(head + "contact_ratio = 0.7\n").error, "");
}

TEST(Answer, HasNoStressIfObservationsExcludeEachOther) {
  // The contact ratio allows a drop of 35 MPa at most, and the drop is sharp.
  const EventResult r = result_of(
      "[event]\nrupture_velocity = \"3 km/s\"\nslip_velocity = \"0.5 m/s\"\nstress_drop = \"69.5 +- 0.2 MPa\"\n"
      "[medium]\ncontact_ratio = { mean = 0.01, sd = 0.001 }\n");
  ASSERT_TRUE(r.estimate && r.posterior) << r.error;
  EXPECT_TRUE(r.posterior->contradicted && !r.posterior->tension.empty());
  EXPECT_FALSE(r.estimate->damping_number || r.estimate->stress_pa || r.estimate->contact_ratio);
  EXPECT_TRUE(mentions(r, "standard deviations"));
  EXPECT_TRUE(std::isnan(in_file(r, "stress_pa")));
}

TEST(Answer, DrawsFromThePosterior) {
  const EventResult r = result_of(tohoku("12 */ 1.5 m", "40 */ 1.4 s", "40 GPa"), {.sampling = {.draws = 500}});
  ASSERT_EQ(r.posterior->draws.size(), 500u);
  std::vector<double> values;
  for (const FaultState& s : r.posterior->draws) {
    EXPECT_TRUE(std::isnan(s.damping_number));
    EXPECT_NEAR(rupture::from_rupture_velocity(s.rupture_velocity).stress, s.stress, 1e-12);
    values.push_back(s.stress_pa_bound);
  }
  std::sort(values.begin(), values.end());
  EXPECT_NEAR(values[249] / r.posterior->stress_pa_bound->median, 1, 0.05);
  EXPECT_NEAR(values[25] / r.posterior->stress_pa_bound->low, 1, 0.1);
}

/// If rise time and duration are both known, T is the duration.
TEST(Answer, AveragesFrictionOverTheDuration) {
  const auto with = [](const std::string& times) {
    return result_of("[event]\nrupture_velocity = \"3 km/s\"\nslip = \"0.5 m\"\n" + times +
                     "[medium]\ncontact_ratio = 0.01\nasperity_spacing = \"1 m\"\n");
  };
  const EventResult both = with("rise_time = \"1 s\"\nduration = \"7 s\"\n"), rise = with("rise_time = \"1 s\"\n");
  ASSERT_TRUE(both.estimate && rise.estimate) << both.error << rise.error;
  EXPECT_DOUBLE_EQ(*both.estimate->observed_slip_velocity_m_s, 0.5);
  EXPECT_EQ(both.observation.measure(), SlipVelocityKind::time_mean);
  EXPECT_DOUBLE_EQ(both.estimate->damping_number->value, rise.estimate->damping_number->value);
  EXPECT_NEAR(rise.estimate->friction_coefficient->value / both.estimate->friction_coefficient->value, 7, 1e-9);
}

TEST(Answer, WarnsIfSourcesDisagree) {
  std::vector<Entry> entries;
  const auto sink = [&](Entry&& entry) { entries.push_back(std::move(entry)); };
  read_events(
      "name,date,rupture_velocity,slip_velocity\n"
      "Loma Prieta 1989 (one),1989-10-18,2.9 km/s,4.4 m/s\n"
      "Loma Prieta (two),10/18/1989,3 km/s,1.4 m/s\n"
      "Elsewhere,1989-10-18,3 km/s,0.1 m/s\n"
      "Near,1992-06-28,3 km/s,0.5 m/s\n"
      "Near again,1992-06-28,3 km/s,0.6 m/s\n"
      "Slow,2006,3 km/day,1 mm/day\n"
      "slow,2006,3 km/day,9 mm/day\n"
      "Slow south,2006,3 km/day,90 mm/day\n"
      "Undated,,3 km/s,0.5 m/s\n"
      "Undated,,3 km/s,5 m/s\n",
      "a.csv", sink);
  warn_of_other_sources(entries, {});
  std::vector<bool> warned;
  for (const Entry& entry : entries) warned.push_back(!entry.observation.warnings.empty());
  EXPECT_EQ(warned, (std::vector<bool>{true, true, false, false, false, true, true, false, false, false}));
  EXPECT_NE(entries[0].observation.warnings[0].find("a.csv:3) to "), std::string::npos)
      << entries[0].observation.warnings[0];
}

TEST(ParetoK, RecoversTheTailOfADistribution) {
  for (const double k : {0.2, 0.5, 0.9}) {
    std::vector<double> weights;
    constexpr int n = 40000;
    for (int i = 0; i < n; ++i) weights.push_back(std::pow((i + 0.5) / n, -k));  // P(w > x) = x^(-1/k)
    EXPECT_NEAR(pareto_k(weights), k, 0.07) << k;
  }
  EXPECT_EQ(pareto_k(std::vector<double>(1000, 0.3)), 0);
  EXPECT_TRUE(std::isinf(pareto_k({1, 2, 3})));
  EXPECT_NEAR(most_pareto_k(1000), 2 / 3.0, 1e-12);
  EXPECT_EQ(most_pareto_k(1e5), 0.7);
}

}  // namespace
