#include "slipfront/events/inference/posterior.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <boost/math/special_functions/erf.hpp>
#include <cmath>
#include <functional>
#include <random>

#include "events/inference/tension.hpp"
#include "slipfront/error.hpp"
#include "slipfront/friction/ratio/table.hpp"
#include "slipfront/theory/medium/medium.hpp"
#include "slipfront/theory/rupture/relations.hpp"

namespace {

using namespace slipfront;
using namespace slipfront::catalogue;
using namespace slipfront::inference;
using friction::Closure;
using Shape = MeasuredValue::Shape;

constexpr double shear_modulus = 30e9;
const medium::Defaults defaults{};
const double c = medium::speed_from_p_wave(defaults.p_wave_speed, defaults.poisson_ratio);
const double plastic = medium::plastic_contact_ratio(defaults.poisson_ratio);

MeasuredValue exact(double x) { return {x, x}; }
MeasuredValue lognormal(double x, double factor) { return {x, x, Shape::lognormal, factor}; }

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
  double slip_velocity(SlipVelocityKind measure, Closure closure) const {
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
    o.slip_velocity_is = static_cast<SlipVelocityKind>(n % 4);
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
    o.slip_velocity_m_s =
        lognormal(random.lognormal(truth.slip_velocity(SlipVelocityKind::origin, Closure::paper), 1.15), 1.15);
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
void expect_posterior_of_grid(Observation o, const MeasuredValue& contact) {
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
            o.slip_velocity_m_s->likelihood(state.slip_velocity(SlipVelocityKind::origin, Closure::consistent)) *
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
  o.rupture_velocity_m_s = MeasuredValue{3000, 3000, Shape::normal, 150};
  o.slip_velocity_m_s = lognormal(0.5, 1.2);
  const MeasuredValue contact{0.01, 0.01, Shape::normal, 0.002};
  o.rupture_velocity_is = RuptureVelocityIs::characteristic;
  o.stress_drop_is = StressDropIs::stored;
  o.stress_drop = MeasuredValue{50e6, 120e6};
  expect_posterior_of_grid(o, contact);
  o.rupture_velocity_is = RuptureVelocityIs::front;
  o.stress_drop_is = StressDropIs::static_drop;
  o.stress_drop = lognormal(15e6, 1.5);
  expect_posterior_of_grid(o, contact);
  o.slip_velocity_m_s = MeasuredValue{0.5, 0.5, Shape::normal, 0.25};
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
    for (const SlipVelocityKind m : friction_ratio::all_slip_velocity_kinds) {
      o.slip_velocity_is = m;
      o.slip_velocity_m_s = exact(truth.slip_velocity(m, closure));
      const Posterior p = *posterior(o, defaults, {.samples = 10, .closure = closure});
      EXPECT_NEAR(p.damping_number->median, truth.damping, 1e-8);
      EXPECT_NEAR(p.damping_number->low, p.damping_number->high, 1e-8);
      EXPECT_NEAR(p.stress_pa->median, truth.stress_pa(), 1);
      EXPECT_NEAR(p.friction_coefficient->median, 12.5 * 0.5 / (10 * c * 0.01), 1e-8);
    }
}

/// Exact observations are the limit of small errors, also where the rupture velocity is uncertain.
TEST(Posterior, WeighsExactObservationsLikeThoseWithSmallErrors) {
  Observation o;
  o.rupture_velocity_is = RuptureVelocityIs::characteristic;
  o.rupture_velocity_m_s = MeasuredValue{1000, 3200};
  o.slip_velocity_m_s = exact(0.2);
  o.contact_ratio = 0.01;
  const Posterior p = *posterior(o, defaults, {.samples = 4000});
  o.slip_velocity_m_s = lognormal(0.2, 1.02);
  const Posterior limit = *posterior(o, defaults, {.samples = 4000});
  EXPECT_NEAR(p.rupture_velocity->median / limit.rupture_velocity->median, 1, 0.01);
  EXPECT_NEAR(p.rupture_velocity->low / limit.rupture_velocity->low, 1, 0.01);
  EXPECT_NEAR(std::log1p(p.damping_number->median), std::log1p(limit.damping_number->median), 0.02);
  EXPECT_NEAR(std::log1p(p.damping_number->low), std::log1p(limit.damping_number->low), 0.02);
  EXPECT_NEAR(std::log1p(p.damping_number->high), std::log1p(limit.damping_number->high), 0.02);
}

/// The static drop of a drawn state is that of a pulse with its velocity, contact ratio and damping number.
TEST(Posterior, DrawsStaticDropsOfTheirPulses) {
  Observation o;
  o.rupture_velocity_is = RuptureVelocityIs::characteristic;
  o.rupture_velocity_m_s = lognormal(2500, 1.1);
  o.slip_velocity_m_s = lognormal(0.5, 1.3);
  o.contact_ratio = 0.01;
  for (const Closure closure : {Closure::consistent, Closure::paper}) {
    const Posterior p = *posterior(o, defaults, {.samples = 1000, .closure = closure, .draws = 20});
    ASSERT_EQ(p.draws.size(), 20u);
    for (const FaultState& s : p.draws) {
      const Truth truth{s.rupture_velocity_m_s, s.contact_ratio, s.damping_number};
      EXPECT_NEAR(s.stress_pa / truth.stress_pa(), 1, 1e-12);
      EXPECT_NEAR(s.static_drop_pa / truth.static_drop_pa(closure), 1, 1e-9);
    }
  }
}

/// Without other observations, the rupture velocity is what was observed, and nothing bounds the contact ratio.
TEST(Posterior, KnowsTheCharacteristicVelocityThatWasObserved) {
  Observation o;
  o.rupture_velocity_is = RuptureVelocityIs::characteristic;
  o.rupture_velocity_m_s = lognormal(2500, 1.1);
  const Posterior p = *posterior(o, defaults, {.samples = 500});
  ASSERT_TRUE(p.characteristic_velocity && p.rupture_velocity);
  EXPECT_EQ(p.characteristic_velocity->low, p.rupture_velocity->low);
  EXPECT_EQ(p.characteristic_velocity->high, p.rupture_velocity->high);
  EXPECT_FALSE(p.contact_ratio || p.contact_ratio_bound);
}

TEST(Posterior, NotesUnidentifiableQuantities) {
  Observation o;
  o.name = "velocities";
  o.rupture_velocity_is = RuptureVelocityIs::characteristic;
  o.rupture_velocity_m_s = MeasuredValue{3000, 3000, Shape::normal, 100};
  o.slip_velocity_m_s = exact(0.5);
  const Posterior p = *posterior(o, defaults, {});
  EXPECT_FALSE(p.friction_identified);
  EXPECT_GT(*p.damping_number_prior_share, 0.4);  // A cannot exceed plastic contact
  ASSERT_GE(p.trade_off.size(), 4u);
  for (const TradeOff& t : p.trade_off)
    EXPECT_NEAR(
        Truth({3000, t.contact_ratio, t.damping_number}).slip_velocity(SlipVelocityKind::origin, Closure::consistent),
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
  // A little faster than without friction is already too fast.
  const rupture::Relations r = rupture::from_rupture_velocity(3000 / c);
  o.slip_velocity_m_s = exact(1.05 * medium::slip_velocity_unit(c, 0.001) * r.slip_velocity);
  EXPECT_NE(complaint().find("above that without friction"), std::string::npos) << complaint();
  o.slip_velocity_m_s = exact(1e-12);
  EXPECT_NE(complaint().find("below that at every damping number"), std::string::npos) << complaint();
  o.rupture_velocity_m_s = exact(5420.9);
  EXPECT_NE(complaint().find("outside the table"), std::string::npos) << complaint();
}

TEST(Posterior, DerivesTheSeedFromTheEvent) {
  Observation o;
  o.name = "a";
  o.rupture_velocity_m_s = MeasuredValue{2000, 3000};
  const Posterior once = *posterior(o, defaults, {}), again = *posterior(o, defaults, {});
  ASSERT_TRUE(once.stress_bound && again.stress_bound);
  EXPECT_EQ(once.stress_bound->low, again.stress_bound->low);
  EXPECT_EQ(once.seed, again.seed);
  EXPECT_NE(once.seed, posterior(o, defaults, {.seed = 2})->seed);
  o.name = "b";
  o.line = 7;
  EXPECT_EQ(once.seed, posterior(o, defaults, {})->seed);
  o.rupture_velocity_m_s = MeasuredValue{2000, 3001};
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

/// A velocity of the fault, a slip velocity and a contact ratio that contradict each other.
struct Contradiction {
  MeasuredValue V, w, A;

  Observation observation() const {
    Observation o;
    o.rupture_velocity_m_s = V;
    o.rupture_velocity_is = RuptureVelocityIs::characteristic;
    o.slip_velocity_m_s = w;
    o.contact_ratio = A.low;
    o.uncertain_constants.push_back({&medium::Constants::contact_ratio, A});
    return o;
  }

  /// The probability that a repeated observation of x is below the actual one.
  static double below(const MeasuredValue& m, double x) {
    const double spread = m.shape == Shape::split && x < m.low ? m.spread_below : m.spread;
    const double z = m.shape == Shape::lognormal ? std::log(m.low / x) / std::log(spread) : (m.low - x) / spread;
    return std::erfc(-z / std::sqrt(2.0)) / 2;
  }

  struct Cell {
    double V, width;  ///< width in ln V
  };
  /// Cells of V. They are 2 % wide for slow pulses, and 5 % of the stress for fast ones, whose V hardly changes. Pulses
  /// that are slower than a tenth of the observed one slip too slowly to count.
  std::vector<Cell> cells_of_V() const {
    const auto range = friction_ratio::stress_range();
    const auto V_of = [](double stress) { return rupture::from_stress(stress).rupture_velocity * c; };
    std::vector<Cell> cells;
    for (double k = std::fmax(range.least, rupture::from_rupture_velocity(V.low / c / 10).stress);
         k < range.most * (1 - 1e-9);) {
      const double slope = std::log(V_of(k * 1.001) / V_of(k)) / std::log(1.001);
      const double factor = std::fmin(range.most / k, std::exp(std::fmin(0.05, 0.02 / slope)));
      cells.push_back({V_of(k * std::sqrt(factor)), std::log(V_of(k * factor) / V_of(k))});
      k *= factor;
    }
    return cells;
  }

  /// The standard deviations by which each observation is above the prediction of the other two, from sums over a grid
  /// of V, the damping number and A. The order is that of the members.
  std::array<double, 3> tensions() const {
    constexpr int cells_of_damping = 80;
    constexpr double step_A = 0.04;
    std::array<double, 3> under{}, over{};
    for (const Cell& cell : cells_of_V())
      for (int j = 0; j < cells_of_damping; ++j) {
        const double share = (j + 0.5) / cells_of_damping;  // fine near 0, where the largest slip velocities are
        const double damping = std::expm1(std::log1p(most_damping_number) * share * share);
        const double w_of_A = Truth{cell.V, 1, damping}.slip_velocity(observation().measure(), Closure::consistent);
        const double LV = V.likelihood(cell.V), below_V = below(V, cell.V);
        const double from = std::fmin(A.low, w.low / w_of_A) * std::exp(-5);
        const double to = std::fmin(plastic, std::fmax(A.low, w.low / w_of_A) * std::exp(3));
        for (double a = to * std::exp(-step_A / 2); a > std::fmax(from, 1e-8); a *= std::exp(-step_A)) {
          const double LA = A.likelihood(a), Lw = w.likelihood(w_of_A * a);
          if (LA < 1e-25 && Lw < 1e-25) continue;
          const double others[] = {LA * Lw, LV * LA, LV * Lw};
          const double parts[] = {below_V, below(w, w_of_A * a), below(A, a)};
          for (std::size_t m = 0; m < 3; ++m) {
            under[m] += cell.width * share * others[m] * parts[m];
            over[m] += cell.width * share * others[m] * (1 - parts[m]);
          }
        }
      }
    std::array<double, 3> sigmas{};
    for (std::size_t m = 0; m < 3; ++m) {
      const double part = std::fmin(under[m], over[m]) / (under[m] + over[m]);
      const double z = std::sqrt(2.0) * boost::math::erfc_inv(2 * part);
      sigmas[m] = under[m] < over[m] ? -z : z;
    }
    return sigmas;
  }
};

/// Expects each tension of 2.1 standard deviations and more, and the number of each to 0.1. Returns how many there are.
std::size_t expect_tensions_of_grid(const Contradiction& example) {
  const std::array<double, 3> expected = example.tensions();
  const std::vector<Tension> found = tensions(example.observation(), defaults, {});
  const auto index = [](const Tension& t) {
    return t.observation == "rupture_velocity" ? 0 : t.observation == "slip_velocity" ? 1 : 2;
  };
  for (const Tension& t : found) {
    EXPECT_TRUE(t.sigmas) << t.observation;
    if (t.sigmas) {
      EXPECT_NEAR(*t.sigmas, expected[static_cast<std::size_t>(index(t))], 0.1) << t.observation;
    }
  }
  for (int m = 0; m < 3; ++m)
    if (std::fabs(expected[static_cast<std::size_t>(m)]) > 2.1) {
      EXPECT_TRUE(std::any_of(found.begin(), found.end(), [&](const Tension& t) { return index(t) == m; })) << m;
    }
  return found.size();
}

TEST(Posterior, ComputesTensionsAsADenseGridDoes) {
  for (const Contradiction& example : {Contradiction{lognormal(3000, 1.1), lognormal(0.5, 1.1), lognormal(0.0005, 1.2)},
                                       Contradiction{lognormal(3000, 1.06), lognormal(0.5, 1.2), lognormal(0.001, 1.3)},
                                       Contradiction{lognormal(1200, 1.2), lognormal(2, 1.3), lognormal(0.004, 1.5)}}) {
    EXPECT_GE(expect_tensions_of_grid(example), 2u);
    const Observation o = example.observation();
    const Posterior p = *posterior(o, defaults, {}), other_seed = *posterior(o, defaults, {.seed = 7});
    ASSERT_EQ(p.tension.size(), other_seed.tension.size());
    for (std::size_t i = 0; i < p.tension.size(); ++i) EXPECT_EQ(p.tension[i].sigmas, other_seed.tension[i].sigmas);
  }
}

MeasuredValue with_random_shape(Random& random, double x, double error) {
  switch (static_cast<int>(random.uniform(0, 3))) {
    case 0:
      return {x, x, Shape::normal, error * x};
    case 1:
      return {x, x, Shape::split, error * x, random.uniform(0.5, 1) * error * x};
    default:
      return lognormal(x, 1 + error);
  }
}

/// A slip velocity above that of the fault without friction, by 2.5 to 6 of its standard deviations with that of A.
TEST(Posterior, ComputesRandomTensionsAsADenseGridDoes) {
  std::size_t count = 0;
  for (std::uint64_t n = 0; n < 30; ++n) {
    SCOPED_TRACE(n);
    Random random{std::mt19937_64(n)};
    const double V = c * std::exp(random.uniform(std::log(0.02), std::log(0.8)));
    const double A = std::exp(random.uniform(std::log(1e-5), std::log(0.05)));
    const double error_A = random.uniform(0.1, 0.4), error_w = random.uniform(0.1, 0.4);
    Contradiction example{
        with_random_shape(random, V, random.uniform(0.05, 0.3)), {}, with_random_shape(random, A, error_A)};
    const double w = Truth{V, A, 0}.slip_velocity(example.observation().measure(), Closure::consistent);
    const double apart = std::exp(random.uniform(2.5, 6) * std::hypot(error_A, error_w));
    example.w = with_random_shape(random, w * apart, error_w);
    count += expect_tensions_of_grid(example);
  }
  EXPECT_GE(count, 45u);
}

/// A normal error of 60 % reaches 0, but must not make the smallest numbers decide.
TEST(Posterior, HasIntervalsForLargeNormalErrors) {
  for (const double share : {0.1, 0.4, 0.6})
    for (const bool of_slip : {false, true}) {
      Observation o;
      o.rupture_velocity_m_s = MeasuredValue{2000, 2000, Shape::normal, of_slip ? 200 : 2000 * share};
      o.slip_velocity_m_s = MeasuredValue{0.5, 0.5, Shape::normal, of_slip ? 0.5 * share : 0.05};
      const Posterior p = *posterior(o, defaults, {});
      ASSERT_TRUE(p.suffices && p.contact_ratio) << share;
      EXPECT_GT(p.contact_ratio->low, 2e-4) << share;
    }
}

}  // namespace
