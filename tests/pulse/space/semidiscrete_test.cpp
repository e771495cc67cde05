// Rates and times that the equations in the cells report, for trains in which they are known.

#include "averages/pulse/space/semidiscrete.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <utility>
#include <vector>

#include "averages/pulse/grid/cells.hpp"

namespace {

using namespace slipfront;
using pulse::Edge;
using pulse::Semidiscrete;

/// The problem of some cells, and their unknowns and rates.
struct Called {
  explicit Called(std::size_t cells) : y(pulse::Values::size(cells), 0), rates(y.size(), 0) {}
  Semidiscrete called() {
    Semidiscrete equations(setup);
    equations.start_from(std::vector<double>(setup.charge.size(), 0.3));
    equations(0, y.data(), rates.data());
    return equations;
  }
  pulse::Setup setup;
  std::vector<double> y, rates;
};

/// Cells around gaps at 4 and 5, all of one width, with this momentum per dislocation.
struct TwoTrains : Called {
  static constexpr std::size_t cells = 12;

  TwoTrains(const friction::Friction& friction, double width, double momentum) : Called(cells) {
    setup.charge.assign(cells, 0.05);
    setup.charge[4] = setup.charge[5] = 0;
    setup.left = setup.right = Edge::continued;
    setup.friction = friction;
    const pulse::Values values(y.data(), cells);
    for (std::size_t i = 0; i < cells; ++i) {
      values.width(i) = width;
      values.momentum(i) = momentum * setup.charge[i];
    }
  }
};

TEST(Semidiscrete, ReportsTheRateOfViscousFriction) {
  TwoTrains trains(friction::viscous(1e-3), 0.4, 0.7);
  const Semidiscrete equations = trains.called();
  EXPECT_EQ(equations.largest_friction_rate(), 1e-3);
  EXPECT_NEAR(equations.mean_friction_rate(), 1e-3, 1e-12);
  EXPECT_NEAR(equations.friction_rate_of_fastest(), 1e-3, 1e-12);
}

/// All dislocations are equal, and so are the three rates: 2 pi <f> / M.
TEST(Semidiscrete, ReportsTheRateOfOtherFriction) {
  for (const friction::Friction& f : {friction::power(1e-3, 2), friction::power(1e-3, 0.6)}) {
    TwoTrains trains(f, 0.4, 0.7);
    const Semidiscrete equations = trains.called();
    const double rate = 2 * std::numbers::pi * f.mean_strength(equations.states()[2], 1) / 0.7;
    EXPECT_NEAR(equations.largest_friction_rate() / rate, 1, 1e-6) << f.name();
    EXPECT_NEAR(equations.mean_friction_rate() / rate, 1, 1e-6) << f.name();
    EXPECT_NEAR(equations.friction_rate_of_fastest() / rate, 1, 1e-6) << f.name();
  }
}

TEST(Semidiscrete, ReportsTheRateOfTheFastestTrain) {
  const friction::Friction f = friction::power(1e-3, 2);
  TwoTrains trains(f, 0.4, 0.7);
  const pulse::Values values(trains.y.data(), TwoTrains::cells);
  for (std::size_t i = 6; i < TwoTrains::cells; ++i) values.momentum(i) *= -2;
  const Semidiscrete equations = trains.called();
  const double rate = 2 * std::numbers::pi * f.mean_strength(equations.states()[8], 1) / 1.4;
  EXPECT_NEAR(equations.friction_rate_of_fastest() / rate, 1, 1e-6);
}

/// Dislocations that are far apart and slow have the same rates, and those at rest have the limit of slow ones.
TEST(Semidiscrete, ReportsTheRateOfSlowDiluteTrains) {
  for (const friction::Definition* law : friction::laws()) {
    if (law->name != "n-shaped") continue;
    const friction::Friction f(*law, {0.1, 0.05});
    for (const double width : {0.4, 1.5}) {
      TwoTrains slow(f, width, 1e-8), rests(f, width, 0);
      const Semidiscrete equations = slow.called();
      const double rate = 2 * std::numbers::pi * f.mean_strength(equations.states()[2], 1) / 1e-8;
      EXPECT_NEAR(equations.largest_friction_rate() / rate, 1, 1e-6) << width;
      EXPECT_NEAR(rests.called().largest_friction_rate() / rate, 1, 1e-4) << width;
    }
  }
}

/// Sound crosses a cell at rest in width / c0. Gaps count as cells without width.
TEST(Semidiscrete, ReportsTheTimeInWhichSoundCrossesACell) {
  TwoTrains trains(friction::Friction{}, 0.4, 0);
  const Semidiscrete equations = trains.called();
  const double mean_width = 0.4 * 10 / 12, speed = equations.trains().sound_speed[2];
  EXPECT_GT(speed, 0.1);
  EXPECT_NEAR(equations.mean_crossing_time(trains.y.data()), mean_width / speed, 1e-14);
}

/// The contact pulls each dislocation of a dilute train by -8 a', also next to free edges, where the density falls
/// fast.
TEST(Semidiscrete, ContactPullsEachDislocationNextToAnEdge) {
  constexpr std::size_t cells = 8;
  constexpr double charge = 0.05, slope = 0.01;
  Called train(cells);
  train.setup.charge.assign(cells, charge);
  train.setup.left = train.setup.right = Edge::free;
  train.setup.contact = [](double x) { return 1 + slope * x; };
  const pulse::Values values(train.y.data(), cells), rates(train.rates.data(), cells);
  for (std::size_t i = 0; i < cells; ++i) values.width(i) = 2 * std::pow(1.4, static_cast<double>(i));
  (void)train.called();
  for (const std::size_t i : {std::size_t{0}, cells - 1})
    EXPECT_NEAR(rates.momentum(i) / (-8 * slope * charge), 1, 1e-9);
  for (std::size_t i = 1; i + 1 < cells; ++i) EXPECT_NEAR(rates.momentum(i) / (-8 * slope * charge), 1, 0.01) << i;
}

/// A train of this many cells from -3 to 3, one of which has more dislocations, or its mirror image.
struct Mirrored : Called {
  static constexpr std::size_t cells = 16;

  Mirrored(bool is_image, Edge edge, bool rough, double collision, double dense) : Called(cells) {
    setup.charge.assign(cells, 0.2);
    setup.charge[is_image ? cells - 1 - 7 : 7] = dense;
    setup.left = setup.right = edge;
    setup.left_wall = -3;
    setup.right_wall = 3;
    setup.friction = friction::power(0.3, 0.6);
    const double sign = is_image ? -1 : 1;
    if (rough) setup.contact = [sign](double x) { return 1 + 0.1 * std::sin(sign * x + 0.3); };
    const pulse::Values values(y.data(), cells);
    values.left_edge() = -3;
    double sum = 0;
    const auto width = [](double at) { return 0.4 + 0.05 * std::sin(0.5 * at) + 0.02 * std::cos(at); };
    for (std::size_t i = 0; i < cells; ++i) sum += width(static_cast<double>(i));
    for (std::size_t i = 0; i < cells; ++i) {
      const auto at = static_cast<double>(is_image ? cells - 1 - i : i);
      values.width(i) = width(at) * 6 / sum;
      values.momentum(i) = sign * setup.charge[i] * (std::sin(0.4 * at) + collision * (at < 6 ? 1 : -1.5));
    }
  }
};

/// No direction along x is preferred, at ends, at collisions, under friction and on a rough contact.
TEST(Semidiscrete, MirrorImagesHaveMirroredRates) {
  constexpr std::size_t n = Mirrored::cells;
  for (const Edge edge : {Edge::free, Edge::wall, Edge::continued})
    for (const bool rough : {false, true})
      for (const auto& [collision, dense] : {std::pair(0.0, 0.2), std::pair(14.0, 0.2), std::pair(14.0, 4.0)}) {
        Mirrored train(false, edge, rough, collision, dense), image(true, edge, rough, collision, dense);
        const Semidiscrete equations = train.called(), mirrored = image.called();
        const pulse::ConstValues rates(train.rates.data(), n), image_rates(image.rates.data(), n);
        double size = 0;
        for (std::size_t i = 0; i < n; ++i) size = std::fmax(size, std::fabs(rates.momentum(i)));
        for (std::size_t i = 0; i < n; ++i) {
          const std::size_t j = n - 1 - i;
          EXPECT_NEAR(rates.width(i), image_rates.width(j), 1e-11) << i;
          EXPECT_NEAR(rates.momentum(i), -image_rates.momentum(j), 1e-11 * size) << i;
          EXPECT_EQ(equations.shocked()[i], mirrored.shocked()[j]) << i;
        }
        EXPECT_NEAR(rates.dissipated(), image_rates.dissipated(), 1e-11 * rates.dissipated());
        EXPECT_EQ(equations.shocked()[5], collision > 0 ? 1 : 0);
        const std::size_t met = equations.crossing(1e3, train.y.data());
        EXPECT_TRUE(collision > 0 ? met == 5 || met == 6 : met == n) << met;
        EXPECT_EQ(mirrored.crossing(1e3, image.y.data()), met == n ? n : n - 1 - met);
      }
}

/// Streams meet if their velocities differ by more than the speed of any wave between them: phi falls by more than the
/// sum of psi. The order is lowered from half that fall on.
TEST(Semidiscrete, StreamsMeetIfNoWavePassesBetweenThem) {
  constexpr std::size_t n = Mirrored::cells;
  std::size_t flattened = 0, met = 0;
  for (int collision = 0; collision <= 14; ++collision) {
    Mirrored train(false, Edge::free, false, collision, 0.2);
    const Semidiscrete equations = train.called();
    const std::vector<State> states = equations.states();
    bool faster = false;
    for (std::size_t i = 1; i + 1 < n; ++i)
      faster = faster || states[i - 1].phi - states[i + 1].phi > states[i - 1].psi + states[i + 1].psi;
    const bool meet = equations.crossing(1e3, train.y.data()) < n;
    EXPECT_EQ(meet, faster) << collision;
    flattened += equations.shocked()[5] != 0 && !meet ? 1u : 0u;
    met += meet ? 1u : 0u;
  }
  EXPECT_GE(flattened, 1u);
  EXPECT_GE(met, 1u);
}

}  // namespace
