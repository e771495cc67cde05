// Contacts that age and pores that dilate, compared with another method (tests/reference/contacts.py), exact limits and
// energy budgets.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <numbers>
#include <string>
#include <vector>

#include "chain_cases.hpp"
#include "lattice/chain/implicit/implicit_chain.hpp"
#include "lattice/chain/model/initial_train.hpp"
#include "lattice/chain/observe/totals.hpp"
#include "lattice/chain/scaled_start.hpp"
#include "slipfront/error.hpp"
#include "slipfront/lattice/chain/run.hpp"
#include "system/archive.hpp"

namespace {

using namespace slipfront;
using chain::Chain;
using chain::ImplicitChain;
using chain::Motion;
using chain::Problem;

/// The parameters of the contacts are beta, theta_c, E, t_p and p_0.
friction::Friction rate_and_state(std::vector<double> law, const std::vector<double>& contacts, double theta = 0) {
  law.insert(law.end(), {theta, 0});
  law.insert(law.end(), contacts.begin(), contacts.end());
  for (const friction::Definition* known : friction::laws())
    if (known->name == "rate-and-state") return {*known, law};
  throw std::logic_error("no such law");
}

Problem with_contacts(const friction::Friction& friction) {
  Problem p;
  p.friction = friction;
  p.longest = 100;
  p.contact = [a = friction.contact_at_start(0)](double) { return a; };
  return p;
}

double budget(const Chain& chain, double first) {
  const chain::Flows flows = chain.flows();
  const double energy = chain::totals(chain).energy(), work = flows.supplied + flows.by_contacts - flows.dissipated;
  return std::fabs(energy - first - work) / std::max({std::fabs(energy), std::fabs(flows.supplied), first});
}

Motion at_rest(std::size_t begin, std::size_t end) { return {std::vector<double>(end - begin, 0.0), {}}; }

struct At {
  double t, u, velocity, theta, p;
};
struct Block {
  std::vector<double> contacts;
  At at[3];
};
/// Values that tests/reference/contacts.py prints.
const Block blocks[] = {
    {{0, 0, 0, 0, 0},
     {{10, 19.0755396844, 2.45183542676, 7.9805683737, 0},
      {30, 62.3383930814, 2.83828431169, 2.54218542464, 0},
      {60, 149.825855387, 3.55860052919, 1.82525375895, 0}}},  // plain
    {{0.1, 5, 0, 0, 0},
     {{10, 16.0642366538, 1.13794046783, 11.8205276388, 0},
      {30, 54.63529493, 2.14172392746, 2.91359561438, 0},
      {60, 135.538685818, 2.87246664412, 1.95957756631, 0}}},  // ages
    {{0, 0, 0.05, 30, 0.1},
     {{10, 20.6246641749, 2.02665855038, 6.60558958659, -0.0218905386127},
      {30, 65.8812485971, 2.18476087116, 2.42376342727, 0.00633460392339},
      {60, 156.085934229, 3.63068202123, 1.76793496917, 0.0559365702311}}},  // dilates
    {{0.1, 5, 0.05, 30, 0.1},
     {{10, 18.4522143633, 2.46332687047, 8.66514101489, -0.0103386723104},
      {30, 60.4616335024, 2.11612333716, 2.67391116649, 0.00732796920145},
      {60, 145.946396319, 3.36849654546, 1.81958624921, 0.0540773366387}}},  // both
};

/// A force F = 0.06 pushes a block over its substrate. All sites start at u = 0 with a velocity of 2.5.
std::unique_ptr<Chain> moving_block(const Block& block, double spacing, bool implicit, double tolerance) {
  Problem p = with_contacts(rate_and_state({0.05, 0.01, 0.015, 6, 0.05}, block.contacts));
  p.grid = {0, spacing, 8};
  p.forcing = [](double, double) { return 0.06; };
  p.steady_forcing = true;
  p.implicit = implicit;
  p.tolerance = tolerance;
  return chain::make_chain(p, [](std::size_t begin, std::size_t end) -> Motion {
    return {std::vector<double>(end - begin, 0.0), std::vector<double>(end - begin, 2.5)};
  });
}

TEST(Contacts, ExplicitStepsOfABlockAgreeWithAnotherMethod) {
  for (const Block& block : blocks) {
    double last = 0;
    for (const double h : {0.05, 0.025}) {
      const auto chain = moving_block(block, h, false, 0);
      double most = 0;
      for (const At& at : block.at) {
        chain->advance_to(at.t);
        const chain::Window now = chain->window(3, 4, at.t);
        most = std::max({most, std::fabs(now.u[0] - at.u), std::fabs(now.velocity[0] - at.velocity)});
        EXPECT_NEAR(1 - now.effective_stress[0], at.p, 0.003 * h);
      }
      EXPECT_LT(most, 0.2 * h);
      if (last > 0) {
        EXPECT_GT(last / most, 1.7);  // friction is of first order in the step
      }
      last = most;
    }
  }
}

TEST(Contacts, ImplicitStepsOfABlockAgreeWithAnotherMethod) {
  for (const Block& block : blocks) {
    const auto chain = moving_block(block, 0.5, true, 1e-7);
    const double first = chain::totals(*chain).energy();
    for (const At& at : block.at) {
      chain->advance_to(at.t);
      const chain::Window now = chain->window(3, 4);
      EXPECT_NEAR(now.u[0], at.u, 2e-3) << at.t;
      EXPECT_NEAR(now.velocity[0], at.velocity, 2e-3) << at.t;
      EXPECT_NEAR(1 - now.effective_stress[0], at.p, 1e-5) << at.t;
    }
    EXPECT_LT(budget(*chain, first), 1e-10);
    if (block.contacts[0] + block.contacts[2] > 0) {
      EXPECT_GT(std::fabs(chain->flows().by_contacts), 1e-3);
    }
  }
}

/// A chain whose left half has the numbers of one block and whose right half has those of another. At both ends it
/// moves as these blocks do, until a wave comes from the middle.
TEST(Contacts, NumbersThatVaryAreThoseOfEachSite) {
  constexpr double end = 10, middle = 16, tolerance = 1e-5;
  const std::vector<double> law[2] = {{0.05, 0.01, 0.015, 6, 0.05}, {0.04, 0.012, 0.014, 5, 0.04}},
                            contacts[2] = {{0.1, 5, 0.05, 30, 0.1}, {0.2, 3, 0.02, 0, 0}};
  const friction::Friction friction[2] = {rate_and_state(law[0], contacts[0]), rate_and_state(law[1], contacts[1])};
  friction::Friction both = friction[0];
  const std::vector<friction::Parameter>& parameters = both.definition().parameters;
  for (const friction::Parameter& p : parameters) {
    const double one = friction[0].parameter(p.name), other = friction[1].parameter(p.name);
    if (one == other) continue;
    both = both.with(p.name, {[=](double x, double) { return x < middle ? one : other; }, std::fmin(one, other),
                              std::fmax(one, other)});
  }
  const auto make = [&](const friction::Friction& f, std::size_t sites, bool implicit) {
    Problem p = with_contacts(f);
    p.contact = [f](double x) { return f.contact_at_start(x); };
    p.grid = {0, 0.4, sites};
    p.forcing = [](double, double) { return 0.06; };
    p.steady_forcing = true;
    p.implicit = implicit;
    p.step = implicit ? 0 : 0.1;
    p.tolerance = tolerance;
    return chain::make_chain(p, [](std::size_t begin, std::size_t to) -> Motion {
      return {std::vector<double>(to - begin, 0.0), std::vector<double>(to - begin, 2.5)};
    });
  };
  for (const bool implicit : {false, true}) {
    const auto whole = make(both, 81, implicit);
    const double first = chain::totals(*whole).energy();
    whole->advance_to(end);
    EXPECT_LT(budget(*whole, first), implicit ? 1e-10 : 0.01);
    for (const std::size_t half : {0u, 1u}) {
      const auto block = make(friction[half], 8, implicit);
      block->advance_to(end);
      const std::size_t site = half == 0 ? 3 : 77;
      const chain::Window mine = whole->window(site, site + 1, end), one = block->window(3, 4, end);
      const double allowed = implicit ? 300 * tolerance : 1e-9;
      EXPECT_NEAR(mine.u[0], one.u[0], allowed);
      EXPECT_NEAR(mine.velocity[0], one.velocity[0], allowed);
      EXPECT_NEAR(mine.contact_squared[0], one.contact_squared[0], allowed);
      EXPECT_NEAR(mine.effective_stress[0], one.effective_stress[0], allowed);
    }
    EXPECT_GT(std::fabs(whole->window(3, 4, end).u[0] - whole->window(77, 78, end).u[0]), 1);
  }
}

/// The balance holds for steps of any length, also where a block slips by radians while its contacts age.
TEST(Contacts, LongImplicitStepsConserveEnergy) {
  for (const Block& block : blocks) {
    const auto chain = moving_block(block, 0.5, true, 0.1);
    const double first = chain::totals(*chain).energy();
    chain->advance_to(60);
    EXPECT_LT(budget(*chain, first), 1e-10);
  }
}

/// The growth rate of a small disturbance of steady sliding, for a block on a spring without a substrate.
double growth(double stiffness, const std::vector<double>& contacts) {
  const double f0 = 0.05, a = 0.01, b = 0.015, D = 1, w0 = 0.01, v = 0.001;
  Problem p;
  p.grid = {0, 0.5, 8};
  p.implicit = true;
  p.substrate = false;
  p.friction = rate_and_state({f0, a, b, D, w0}, contacts, D / v);
  p.loading = {.stiffness = stiffness, .velocity = v};
  const double steady = a * std::asinh(v / (2 * w0) * std::exp((f0 + b * std::log(w0 / v)) / a)) * (1 - contacts[4]);
  p.forcing = [steady](double, double) { return steady; };
  p.tolerance = 2e-9 * v;
  ImplicitChain chain(p, {std::vector<double>(8, 0.0), std::vector<double>(8, 1.01 * v)});
  // The first two peaks come from the start and from inertia.
  return growth_of_peaks(chain, v, 10 * 2 * std::numbers::pi * D / v, 2);
}

/// Dilatancy stabilises. The critical stiffness is ((1 - p_0)(b - a) - E f) / D for pores that do not drain and
/// (1 - p_0)(b - a) / D for pores that drain at once (Segall & Rice 1995). For slow drainage we compare with the
/// eigenvalues of tests/reference/contacts.py.
TEST(Contacts, CriticalStiffnessWithDilatancyAgreesWithTheEigenvalues) {
  const struct {
    double E, drainage, p0, critical;
  } cases[] = {{0.03, 0, 0, 0.0031548807}, {0.03, 1000, 0, 0.0044774273}, {0.03, 1000, 0.4, 0.0025290860}};
  for (const auto& c : cases) {
    const std::vector<double> contacts = {0, 0, c.E, c.drainage, c.p0};
    const double low = growth(0.99 * c.critical, contacts), high = growth(1.01 * c.critical, contacts);
    EXPECT_GT(low, 0) << c.drainage;
    EXPECT_LT(high, 0) << c.drainage;
    EXPECT_NEAR(0.99 + 0.02 * low / (low - high), 1, 1e-3) << c.drainage << ' ' << c.p0;
  }
}

/// The reference numbers are those that tests/reference/contacts.py prints.
TEST(Contacts, LimitCycleWithDilatancyAgreesWithAHighOrderIntegration) {
  const struct { double drainage, period, peak; } cases[] = {{1e3, 119814.01, 1.9352069}, {1e5, 117955.84, 1.8858962}};
  for (const auto& c : cases) {
    Problem p;
    p.grid = {0, 0.5, 8};
    p.implicit = true;
    p.substrate = false;
    p.friction = rate_and_state({0.05, 0.01, 0.015, 1, 0.01}, {0, 0, 0.02, c.drainage, 0});
    p.loading = {.stiffness = 0.0012, .velocity = 0.001, .event_velocity = 0.01};
    p.tolerance = 3e-6;
    ImplicitChain chain(p, {std::vector<double>(8, 0.0), {}});
    chain.advance_to(8.5 * c.period);
    const auto events = chain.events();
    ASSERT_GE(events.size(), 8u);
    EXPECT_NEAR((events[7].onset - events[6].onset) / c.period, 1, 1e-3);
    EXPECT_NEAR(events[7].peak_velocity / c.peak, 1, 1e-3);
    EXPECT_LT(budget(chain, 0), 1e-10);
  }
}

chain::ScaledProblem step(const std::vector<double>& contacts) {
  chain::ScaledProblem s = small_step();
  s.end = 2;
  s.spacing = 0.3;
  s.friction = rate_and_state({0.05, 0.01, 0.015, 0.05, 0.05}, contacts);
  s.contact = [a = s.friction.contact_at_start(0)](double) { return a; };
  return s;
}

TEST(Contacts, PressureInUndrainedPoresFollowsTheLogarithmOfTheta) {
  chain::Run run(step({0, 0, 0.02, 0, 0.3}), until(2), {});
  const std::vector<double> first = levels_of(run).state;
  ASSERT_TRUE(run.go());
  const std::vector<double> last = levels_of(run).state;
  double most = 0;
  for (std::size_t i = 0; i < last.size(); i += 3) {
    EXPECT_NEAR(last[i + 1], 0.02 * std::log(last[i] / first[i]), 1e-12);
    most = std::fmax(most, std::fabs(last[i + 1]));
  }
  EXPECT_GT(most, 0.02);
}

TEST(Contacts, PoresThatDrainAtOnceKeepTheirPressure) {
  chain::Run drained(step({0, 0, 0.02, 1e-7, 0.3}), until(2), {});
  ASSERT_TRUE(drained.go());
  for (const double share : drained.chain().window(0, drained.chain().problem().grid.sites).effective_stress)
    EXPECT_NEAR(share, 0.7, 1e-5);
  // A constant pore pressure acts like weaker friction on weaker contacts.
  chain::ScaledProblem weak = step({0, 0, 0, 0, 0});
  weak.friction = rate_and_state({0.035, 0.007, 0.0105, 0.05, 0.05}, {});
  weak.contact = [](double) { return 0.7; };
  chain::Run without(weak, until(2), {});
  ASSERT_TRUE(without.go());
  const double slip = without.snapshots().back().slip_at_origin;
  EXPECT_GT(slip, 0.01);
  EXPECT_NEAR(drained.snapshots().back().slip_at_origin / slip, 1, 1e-3);
}

TEST(Contacts, EnergyFromContactsClosesTheBudget) {
  for (const std::vector<double>& contacts :
       {std::vector<double>{0.1, 0.2, 0, 0, 0}, {0, 0, 0.02, 0.5, 0.1}, {0.1, 0.2, 0.02, 0.5, 0.1}}) {
    chain::Run run(step(contacts), until(2), {});
    ASSERT_TRUE(run.go());
    const chain::Balance balance = run.balance();
    EXPECT_LT(balance.energy_drift, 5e-4);
    const double given = run.snapshots().back().energy.contacts * 60, all = chain::totals(run.chain()).energy();
    EXPECT_GT(std::fabs(given) / all, 10 * balance.energy_drift);  // the budget would miss it
  }
}

TEST(Contacts, ThreadsAndStopsChangeNoBits) {
  const chain::ScaledProblem s = step({0.1, 0.2, 0.02, 0.5, 0.1});
  chain::Run alone(s, until(1), {}), threads(s, until(1), {.threads = 3}), stopped(s, until(1), {});
  ASSERT_TRUE(alone.go() && threads.go());
  EXPECT_EQ(levels_of(alone).now, levels_of(threads).now);
  EXPECT_EQ(levels_of(alone).state, levels_of(threads).state);
  stopped.go([] { return true; });
  ASSERT_FALSE(stopped.finished());
  ASSERT_GT(stopped.chain().steps(), 0);
  chain::Run resumed(s, until(1), {}, stopped.saved(), stopped.snapshots());
  ASSERT_TRUE(resumed.go());
  EXPECT_EQ(alone.saved(), resumed.saved());
  for (std::size_t i = 0; i < alone.snapshots().size(); ++i)
    EXPECT_EQ(alone.snapshots()[i].profile.W, resumed.snapshots()[i].profile.W);
}

/// The run stops before its first step, as after a signal that follows the first checkpoint.
TEST(Contacts, ResumingFromTheStartGivesTheSameBits) {
  for (const std::vector<double>& contacts : {std::vector<double>{0.1, 0.2, 0, 0, 0},
                                              {0.05, 0.1, 0, 0, 0},
                                              {0, 0, 0.02, 0.5, 0.1},
                                              {0.3, 7, 0.02, 0.5, 0.1}}) {
    const chain::ScaledProblem s = step(contacts);
    chain::Run whole(s, until(0.3), {});
    const chain::Run begun(s, until(0.3), {});
    chain::Run resumed(s, until(0.3), {}, begun.saved(), begun.snapshots());
    ASSERT_TRUE(whole.go() && resumed.go());
    EXPECT_EQ(whole.saved(), resumed.saved());
  }
}

/// A train under a pulled end, by implicit steps.
TEST(Contacts, ImplicitStepsConserveEnergyAndResumeToTheSameBits) {
  Problem p = with_contacts(rate_and_state({0.05, 0.01, 0.015, 3, 0.05}, {0.1, 10, 0.02, 30, 0.1}));
  p.grid = {0, 0.3, 401};
  p.boundary = {.left = chain::End::free, .right = chain::End::fixed};
  p.implicit = true;
  p.loading = {.stiffness = 1e-3, .velocity = 0.1, .event_velocity = 1};
  const Motion start = chain::static_train([](double x) { return x < 60 ? 0.8 : 0.0; }, p.grid, false, p.contact);
  ImplicitChain one(p, start), stopped(p, start);
  const double first = chain::totals(one).energy();
  one.advance_to(40);
  EXPECT_LT(budget(one, first), 1e-12);
  EXPECT_GT(std::fabs(one.flows().by_contacts) / first, 1e-4);
  stopped.advance_to(40, 30);
  ImplicitChain resumed(p, start);
  restore(resumed, saved(stopped));
  EXPECT_EQ(resumed.window(0, 401).contact_squared, stopped.window(0, 401).contact_squared);
  resumed.advance_to(40);
  ASSERT_LT(30, resumed.steps());
  EXPECT_EQ(one.flows().by_contacts, resumed.flows().by_contacts);
  EXPECT_EQ(one.window(0, 401).u, resumed.window(0, 401).u);
  EXPECT_EQ(one.window(0, 401).velocity, resumed.window(0, 401).velocity);
}

/// Friction holds sites at 1e-36, whose contacts age as fast as forces are rounded: Newton's method has to balance all
/// of the force of friction and contacts there.
TEST(Contacts, StepsConvergeWhereFrictionHoldsSitesWhoseContactsAge) {
  Problem p = with_contacts(rate_and_state({0.2, 0.0037, 0.088, 0.287, 0.01}, {0.16, 42, 0, 0, 0}));
  p.grid = {0, 0.2, 201};
  p.boundary = {.left = chain::End::free, .right = chain::End::free};
  p.implicit = true;
  p.loading = {.stiffness = 1.93, .velocity = 2.4e-4, .event_velocity = 1};
  ImplicitChain chain(p, chain::static_train([](double) { return 0.5; }, p.grid, false, p.contact));
  EXPECT_TRUE(chain.advance_to(0.1));
}

/// Contacts at rest heal as ln(1 + t / theta). In pores that do not drain, the pressure rises with them.
TEST(Contacts, ReportsThePositionWhereThePorePressureReachesTheNormalStress) {
  for (const bool implicit : {false, true}) {
    Problem p = with_contacts(rate_and_state({0.05, 0.01, 0.015, 1, 1}, {0, 0, 0.2, 0, 0.5}));
    p.grid = {0, 0.25, 64};
    p.implicit = implicit;
    p.longest = 1000;
    const auto chain = chain::make_chain(p, at_rest);
    try {
      chain->advance_to(1000);
      FAIL();
    } catch (const NumericsError& error) {
      const std::string text = error.what();
      EXPECT_NE(text.find("effective normal stress is -"), std::string::npos) << text;
      EXPECT_NE(text.find("x = 0"), std::string::npos) << text;
      EXPECT_NEAR(chain->time(), std::exp(2.5) - 1, 0.2 * std::exp(2.5)) << text;
    }
  }
}

TEST(Contacts, RejectsOptionsThatContactsDoNotSupport) {
  const auto refuses = [](const Problem& p, const std::string& key) {
    try {
      chain::make_chain(p, at_rest);
      FAIL() << key;
    } catch (const InputError& error) {
      EXPECT_EQ(error.complaint().key, key);
    }
  };
  Problem p = with_contacts(rate_and_state({0.05, 0.01, 0.015, 1, 1}, {0.1, 1, 0, 0, 0}));
  p.grid = {0, 0.3, 64};
  p.boundary.right = chain::End::absorbing;
  refuses(p, "right end");
  p.boundary.right = chain::End::free;
  p.implicit = true;
  p.substrate = false;
  refuses(p, "contact ageing");
  p.implicit = false;
  p.substrate = true;
  p.grid.spacing = 0.62;  // enough for a = 1, too coarse for the largest a that ageing can reach
  refuses(p, "spacing");
}

}  // namespace
