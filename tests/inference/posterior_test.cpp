#include "slipfront/inference/posterior.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <boost/math/special_functions/erf.hpp>
#include <cmath>
#include <functional>
#include <random>

#include "slipfront/error.hpp"
#include "slipfront/friction_ratio/front.hpp"
#include "slipfront/medium/medium.hpp"
#include "slipfront/rupture/relations.hpp"

namespace {

using namespace slipfront;
using namespace slipfront::catalogue;
using namespace slipfront::inference;
using friction::Closure;
using Shape = Measured::Shape;

constexpr double shear_modulus = 30e9;
const medium::Defaults defaults{};
const double c = medium::speed_from_p_wave(defaults.p_wave_speed, defaults.poisson_ratio);
const double plastic = medium::plastic_contact_ratio(defaults.poisson_ratio);

Measured exact(double x) { return {x, x}; }
Measured lognormal(double x, double factor) { return {x, x, Shape::lognormal, factor}; }

/// The state of a fault, with its stress and slip velocity.
struct Truth {
  double V, A, damping;
  double stress() const { return rupture::from_rupture_velocity(V / c).stress; }
  double stress_pa() const { return medium::stress_unit(shear_modulus, A) * stress(); }
  /// The velocity of the front that an observer sees, in m/s.
  double front(Closure closure, double threshold = default_front_threshold) const {
    return V * friction_ratio::front_ratio(closure, stress(), damping, threshold).value;
  }
  double static_drop_pa(Closure closure) const {
    return stress_pa() *
           friction_ratio::stress_drop_share(friction_ratio::Drop::origin, closure, stress(), damping).value;
  }
  double slip_velocity(Measure measure, Closure closure) const {
    const rupture::Relations r = rupture::from_rupture_velocity(V / c);
    return medium::slip_velocity_unit(c, A) * r.slip_velocity *
           friction_ratio::evaluate(measure, closure, r.stress, damping).value;
  }
};

struct Random {
  std::mt19937_64 bits;
  double uniform(double a, double b) { return a + (b - a) * static_cast<double>(bits() >> 11) * 0x1p-53; }
  double lognormal(double x, double factor) { return x * std::exp(std::log(factor) * normal()); }
  double normal() {
    const double u = 1 - uniform(0, 1);
    return std::sqrt(-2 * std::log(u)) * std::cos(uniform(0, 6.283185307179586));
  }
};

/// A state drawn from the sampler's prior distribution.
Truth drawn(Random& random) {
  return {c * std::exp(random.uniform(std::log(1e-6), std::log(0.8))),
          std::exp(random.uniform(std::log(1e-6), std::log(0.3))),
          std::expm1(random.uniform(0, std::log1p(most_damping_number)))};
}

void expect_ninety_percent(const std::vector<std::pair<const char*, int>>& inside, int events) {
  for (const auto& [name, count] : inside) {
    EXPECT_GE(count, 0.87 * events) << name;
    EXPECT_LE(count, 0.93 * events) << name;
  }
}

bool holds(const std::optional<Quantiles>& q, double truth) { return q && q->low <= truth && truth <= q->high; }

TEST(Posterior, CoversTheTruthInNineOfTenEventsWithKnownContact) {
  constexpr int events = 1000;
  int stress = 0, contact = 0, damping = 0, pascal = 0;
  for (int n = 0; n < events; ++n) {
    Random random{std::mt19937_64(static_cast<std::uint64_t>(n))};
    const Truth truth = drawn(random);
    Observation o;
    o.name = "event " + std::to_string(n);
    o.slip_velocity_is = static_cast<Measure>(n % 4);
    o.rupture_velocity_is = n % 2 ? RuptureVelocityIs::front : RuptureVelocityIs::characteristic;
    const double V = n % 2 ? truth.front(Closure::consistent) : truth.V;
    o.rupture_velocity_m_s = lognormal(random.lognormal(V, 1.1), 1.1);
    const double w = truth.slip_velocity(o.measure(), Closure::consistent);
    o.slip_velocity_m_s = lognormal(random.lognormal(w, 1.15), 1.15);
    o.contact_ratio = random.lognormal(truth.A, 1.2);
    o.uncertain_constants.push_back({&medium::Constants::contact_ratio, lognormal(*o.contact_ratio, 1.2)});
    Posterior p;
    try {
      p = *posterior(o, defaults, {.samples = 500});
    } catch (const InputError&) {  // the noise has made the event impossible; it counts as a miss
      continue;
    }
    EXPECT_TRUE(p.friction_identified);
    stress += holds(p.stress, truth.stress());
    contact += holds(p.contact_ratio, truth.A);
    damping += holds(p.damping_number, truth.damping);
    pascal += holds(p.stress_pa, truth.stress_pa());
  }
  expect_ninety_percent({{"stress", stress}, {"contact_ratio", contact}, {"damping", damping}, {"stress_pa", pascal}},
                        events);
}

TEST(Posterior, CoversTheTruthInNineOfTenEventsWithKnownFriction) {
  constexpr int events = 1000;
  int contact = 0, damping = 0, pascal = 0;
  for (int n = 0; n < events; ++n) {
    Random random{std::mt19937_64(static_cast<std::uint64_t>(n) + 100000)};
    const Truth truth = drawn(random);
    const double spacing = 1e-3, duration = 30;
    const double C = truth.damping * spacing / (duration * c * truth.A);
    Observation o;
    o.name = "event " + std::to_string(n);
    o.rupture_velocity_is = RuptureVelocityIs::characteristic;
    o.rupture_velocity_m_s = lognormal(random.lognormal(truth.V, 1.1), 1.1);
    o.slip_velocity_m_s = lognormal(random.lognormal(truth.slip_velocity(Measure::origin, Closure::paper), 1.15), 1.15);
    o.friction_coefficient = lognormal(random.lognormal(C, 2), 2);
    o.duration = exact(duration);
    o.asperity_spacing = spacing;
    Posterior p;
    try {
      p = *posterior(o, defaults, {.samples = 500, .closure = Closure::paper});
    } catch (const InputError&) {
      continue;
    }
    contact += holds(p.contact_ratio, truth.A);
    damping += holds(p.damping_number, truth.damping);
    pascal += holds(p.stress_pa, truth.stress_pa());
  }
  expect_ninety_percent({{"contact_ratio", contact}, {"damping", damping}, {"stress_pa", pascal}}, events);
}

/// The posterior by brute force: likelihood times prior on a grid over (ln V, ln A, u).
struct OnGrid {
  std::vector<std::pair<double, double>> A, u;
  static Quantiles quantiles(std::vector<std::pair<double, double>> values) {
    std::sort(values.begin(), values.end());
    double total = 0;
    for (const auto& v : values) total += v.second;
    const auto at = [&](double share) {
      double sum = 0;
      for (const auto& v : values)
        if ((sum += v.second) >= share * total) return v.first;
      return values.back().first;
    };
    return {at(0.05), at(0.5), at(0.95)};
  }
};

/// Integrates prior x likelihood of an event over a grid, and compares it with the samples.
void expect_posterior_of_grid(Observation o, const Measured& contact) {
  o.contact_ratio = contact.middle();
  o.uncertain_constants.push_back({&medium::Constants::contact_ratio, contact});
  const bool front = o.rupture_velocity_is == RuptureVelocityIs::front;
  OnGrid grid;
  constexpr int n = 60;
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < n; ++j)
      for (int k = 0; k < n; ++k) {
        const double V = 3000 * std::exp(-0.3 + 0.85 * (i + 0.5) / n), A = 0.01 * std::exp((j + 0.5) / n * 2.4 - 1.6);
        const double u = (k + 0.5) / n * 6;
        const Truth state{V, A, std::expm1(u)};
        if (!(V < c) || state.stress() > 3) continue;
        const double seen = front ? state.front(Closure::consistent) : V;
        const double drop =
            o.stress_drop_is == StressDropIs::stored ? state.stress_pa() : state.static_drop_pa(Closure::consistent);
        const double weight =
            o.rupture_velocity_m_s->likelihood(seen) * contact.likelihood(A) *
            o.slip_velocity_m_s->likelihood(state.slip_velocity(Measure::origin, Closure::consistent)) *
            o.stress_drop->likelihood(drop);
        grid.A.emplace_back(A, weight);
        grid.u.emplace_back(u, weight);
      }
  const Posterior p = *posterior(o, defaults, {.samples = 20000});
  const Quantiles A = OnGrid::quantiles(grid.A), u = OnGrid::quantiles(grid.u);
  EXPECT_NEAR(p.contact_ratio->median / A.median, 1, 0.02);
  EXPECT_NEAR(p.contact_ratio->low / A.low, 1, 0.02);
  EXPECT_NEAR(p.contact_ratio->high / A.high, 1, 0.02);
  EXPECT_NEAR(std::log1p(p.damping_number->median), u.median, 0.08);
  EXPECT_NEAR(std::log1p(p.damping_number->low), u.low, 0.08);
  EXPECT_NEAR(std::log1p(p.damping_number->high), u.high, 0.08);
  EXPECT_GT(p.effective_samples, 3000);
}

TEST(Posterior, AgreesWithIntegrationOverAGrid) {
  Observation o;
  o.rupture_velocity_m_s = Measured{3000, 3000, Shape::normal, 150};
  o.slip_velocity_m_s = lognormal(0.5, 1.2);
  const Measured contact{0.01, 0.01, Shape::normal, 0.002};
  o.rupture_velocity_is = RuptureVelocityIs::characteristic;
  o.stress_drop_is = StressDropIs::stored;
  o.stress_drop = Measured{50e6, 120e6};
  expect_posterior_of_grid(o, contact);
  o.rupture_velocity_is = RuptureVelocityIs::front;
  o.stress_drop_is = StressDropIs::static_drop;
  o.stress_drop = lognormal(15e6, 1.5);
  expect_posterior_of_grid(o, contact);
  o.slip_velocity_m_s = Measured{0.5, 0.5, Shape::normal, 0.25};
  expect_posterior_of_grid(o, contact);
}

/// Exact observations determine a single state of the fault.
TEST(Posterior, SolvesExactObservations) {
  const Truth truth{3000, 0.01, 12.5};
  Observation o;
  o.name = "exact";
  o.rupture_velocity_is = RuptureVelocityIs::characteristic;
  o.rupture_velocity_m_s = exact(truth.V);
  o.contact_ratio = truth.A;
  o.duration = exact(10);
  o.asperity_spacing = 0.5;
  for (const Closure closure : {Closure::consistent, Closure::paper})
    for (const Measure m : friction_ratio::all_measures) {
      o.slip_velocity_is = m;
      o.slip_velocity_m_s = exact(truth.slip_velocity(m, closure));
      const Posterior p = *posterior(o, defaults, {.samples = 10, .closure = closure});
      EXPECT_NEAR(p.damping_number->median, truth.damping, 1e-8);
      EXPECT_NEAR(p.damping_number->low, p.damping_number->high, 1e-8);
      EXPECT_NEAR(p.stress_pa->median, truth.stress_pa(), 1);
      EXPECT_NEAR(p.friction_coefficient->median, 12.5 * 0.5 / (10 * c * 0.01), 1e-8);
    }
}

TEST(Posterior, NotesUnidentifiableQuantities) {
  Observation o;
  o.name = "velocities";
  o.rupture_velocity_is = RuptureVelocityIs::characteristic;
  o.rupture_velocity_m_s = Measured{3000, 3000, Shape::normal, 100};
  o.slip_velocity_m_s = exact(0.5);
  const Posterior p = *posterior(o, defaults, {});
  EXPECT_FALSE(p.friction_identified);
  EXPECT_GT(*p.damping_number_prior_share, 0.4);  // A cannot exceed plastic contact
  ASSERT_GE(p.trade_off.size(), 4u);
  for (const TradeOff& t : p.trade_off)
    EXPECT_NEAR(Truth({3000, t.contact_ratio, t.damping_number}).slip_velocity(Measure::origin, Closure::consistent),
                0.5, 1e-6);
  ASSERT_FALSE(p.notes.empty());
  EXPECT_NE(p.notes.front().find("trade off"), std::string::npos);

  o.slip_velocity_m_s.reset();
  const Posterior q = *posterior(o, defaults, {});
  EXPECT_FALSE(q.contact_ratio || q.damping_number || q.stress_pa);
  EXPECT_TRUE(q.stress);
  o.rupture_velocity_m_s.reset();
  EXPECT_FALSE(posterior(o, defaults, {}));
}

TEST(Posterior, RejectsContradictoryObservations) {
  Observation o;
  o.name = "contradiction";
  o.rupture_velocity_is = RuptureVelocityIs::characteristic;
  o.rupture_velocity_m_s = exact(3000);
  o.slip_velocity_m_s = exact(0.5);
  o.contact_ratio = 0.001;
  const auto complaint = [&] {
    try {
      posterior(o, defaults, {});
    } catch (const InputError& error) {
      return std::string(error.what());
    }
    return std::string("accepted");
  };
  EXPECT_NE(complaint().find("above that without friction"), std::string::npos) << complaint();
  o.slip_velocity_m_s = exact(1e-12);
  EXPECT_NE(complaint().find("below that at every damping number"), std::string::npos) << complaint();
  o.rupture_velocity_m_s = exact(5420.9);
  EXPECT_NE(complaint().find("outside the table"), std::string::npos) << complaint();
}

TEST(Posterior, DerivesTheSeedFromTheEvent) {
  Observation o;
  o.name = "a";
  o.rupture_velocity_m_s = Measured{2000, 3000};
  const Posterior once = *posterior(o, defaults, {}), again = *posterior(o, defaults, {});
  ASSERT_TRUE(once.stress_bound && again.stress_bound);
  EXPECT_EQ(once.stress_bound->low, again.stress_bound->low);
  EXPECT_EQ(once.seed, again.seed);
  EXPECT_NE(once.seed, posterior(o, defaults, {.seed = 2})->seed);
  o.name = "b";
  o.line = 7;
  EXPECT_EQ(once.seed, posterior(o, defaults, {})->seed);
  o.rupture_velocity_m_s = Measured{2000, 3001};
  EXPECT_NE(once.seed, posterior(o, defaults, {})->seed);
}

/// The two velocities of an observed front bound A from both sides (docs/events.md).
TEST(Posterior, BoundsTheContactRatioFromBothSidesIfTheFrontWasSeen) {
  Observation o;
  o.rupture_velocity_m_s = exact(10e3 / 86400);
  o.slip = exact(4e-3);
  o.duration = exact(14 * 86400);
  const Posterior p = *posterior(o, defaults, {});
  EXPECT_FALSE(p.friction_identified);
  ASSERT_TRUE(p.contact_ratio && p.stress_pa);
  EXPECT_GT(p.contact_ratio->low, 8e-6);
  EXPECT_LT(p.contact_ratio->high, 4e-5);
  for (const TradeOff& t : p.trade_off) EXPECT_LT(t.contact_ratio, 4e-5);
  EXPECT_FALSE(p.contact_ratio_bound);
}

TEST(Posterior, StatesWhichObservationsAreInTension) {
  Observation o;
  o.rupture_velocity_m_s = lognormal(3000, 1.1);
  o.slip_velocity_m_s = lognormal(0.5, 1.1);
  o.contact_ratio = 0.0005;  // 0.0028 at least
  o.uncertain_constants.push_back({&medium::Constants::contact_ratio, lognormal(0.0005, 1.2)});
  const Posterior p = *posterior(o, defaults, {});
  EXPECT_TRUE(p.contradicted);
  EXPECT_FALSE(p.contact_ratio || p.stress_pa);
  ASSERT_EQ(p.tension.size(), 3u);
  for (const Tension& t : p.tension) {
    if (t.sigmas) {
      EXPECT_GT(std::fabs(*t.sigmas), 2) << t.observation;
    }
    EXPECT_TRUE(t.without.stress) << t.observation;
    if (t.observation == "contact_ratio") {
      EXPECT_GT(t.without.contact_ratio->low, 0.002);
    }
  }
  o.uncertain_constants.back().measured = lognormal(0.0005, 5);  // now they agree
  EXPECT_TRUE(posterior(o, defaults, {})->tension.empty());
}

/// A velocity of the fault, a slip velocity and a contact ratio, each with a lognormal error.
struct Contradiction {
  double V, w, A, V_factor, w_factor, A_factor;

  Observation observation() const {
    Observation o;
    o.rupture_velocity_m_s = catalogue::Measured{V, V, Shape::lognormal, V_factor};
    o.rupture_velocity_is = RuptureVelocityIs::characteristic;
    o.slip_velocity_m_s = catalogue::Measured{w, w, Shape::lognormal, w_factor};
    o.contact_ratio = A;
    o.uncertain_constants.push_back(
        {&medium::Constants::contact_ratio, catalogue::Measured{A, A, Shape::lognormal, A_factor}});
    return o;
  }

  /// The standard deviations by which each observation is above the prediction of the other two, from sums over a grid
  /// of V, the damping number and A. The order is that of the members.
  std::array<double, 3> tensions() const {
    const double sV = std::log(V_factor), sw = std::log(w_factor), sA = std::log(A_factor);
    const auto above = [](double z) { return std::erfc(z / std::sqrt(2.0)) / 2; };
    const auto range = friction_ratio::stress_range();
    // Cells of equal size in ln Sigma-, because V hardly changes with stress near c.
    const auto ln_V_at = [&](double part) {
      const double stress = range.least * std::pow(range.most / range.least, part);
      return std::log(rupture::from_stress(stress).rupture_velocity * c);
    };
    std::array<double, 3> below{}, over{};
    constexpr int cells = 120, cells_of_A = 300;
    const double least_A = std::log(1e-8), step_A = (std::log(plastic) - least_A) / cells_of_A;
    for (int i = 0; i < cells; ++i)
      for (int j = 0; j < cells; ++j) {
        const double ln_V = ln_V_at((i + 0.5) / cells), width = ln_V_at((i + 1.0) / cells) - ln_V_at(double(i) / cells);
        const double share = (j + 0.5) / cells;  // fine near 0, where the largest slip velocities are
        const double damping = std::expm1(std::log1p(most_damping_number) * share * share);
        const Truth truth{std::exp(ln_V), 1, damping};
        const double ln_w = std::log(truth.slip_velocity(observation().measure(), Closure::consistent));
        const double zV = (ln_V - std::log(V)) / sV, LV = std::exp(-zV * zV / 2), below_V = above(zV);
        for (int k = 0; k < cells_of_A; ++k) {
          const double ln_A = least_A + step_A * (k + 0.5);
          const double zA = (ln_A - std::log(A)) / sA, zw = (ln_A + ln_w - std::log(w)) / sw;
          if (std::fabs(zA) > 12 && std::fabs(zw) > 12) continue;
          const double LA = std::exp(-zA * zA / 2), Lw = std::exp(-zw * zw / 2);
          const double others[] = {LA * Lw, LV * LA, LV * Lw};
          const double under[] = {below_V, above(zw), above(zA)};
          for (std::size_t m = 0; m < 3; ++m) {
            below[m] += width * share * others[m] * under[m];
            over[m] += width * share * others[m] * (1 - under[m]);
          }
        }
      }
    std::array<double, 3> sigmas{};
    for (std::size_t m = 0; m < 3; ++m) {
      const double part = std::fmin(below[m], over[m]) / (below[m] + over[m]);
      const double z = std::sqrt(2.0) * boost::math::erfc_inv(2 * part);
      sigmas[m] = below[m] < over[m] ? -z : z;
    }
    return sigmas;
  }
};

TEST(Posterior, ComputesTensionsAsADenseGridDoes) {
  for (const Contradiction& example :
       {Contradiction{3000, 0.5, 0.0005, 1.1, 1.1, 1.2}, Contradiction{3000, 0.5, 0.001, 1.06, 1.2, 1.3},
        Contradiction{1200, 2, 0.004, 1.2, 1.3, 1.5}}) {
    const Observation o = example.observation();
    const std::array<double, 3> expected = example.tensions();
    const Posterior p = *posterior(o, defaults, {}), other_seed = *posterior(o, defaults, {.seed = 7});
    ASSERT_GE(p.tension.size(), 2u);
    for (const Tension& t : p.tension) {
      const std::size_t m = t.observation == "rupture_velocity" ? 0 : t.observation == "slip_velocity" ? 1 : 2;
      ASSERT_TRUE(t.sigmas) << t.observation;
      EXPECT_NEAR(*t.sigmas, expected[m], 0.1) << t.observation;
    }
    ASSERT_EQ(p.tension.size(), other_seed.tension.size());
    for (std::size_t i = 0; i < p.tension.size(); ++i) EXPECT_EQ(p.tension[i].sigmas, other_seed.tension[i].sigmas);
  }
}

/// A normal error of 60 % reaches 0, but must not make the smallest numbers decide.
TEST(Posterior, HasIntervalsForLargeNormalErrors) {
  for (const double share : {0.1, 0.4, 0.6})
    for (const bool of_slip : {false, true}) {
      Observation o;
      o.rupture_velocity_m_s = Measured{2000, 2000, Shape::normal, of_slip ? 200 : 2000 * share};
      o.slip_velocity_m_s = Measured{0.5, 0.5, Shape::normal, of_slip ? 0.5 * share : 0.05};
      const Posterior p = *posterior(o, defaults, {});
      ASSERT_TRUE(p.suffices && p.contact_ratio) << share;
      EXPECT_GT(p.contact_ratio->low, 2e-4) << share;
    }
}

}  // namespace
