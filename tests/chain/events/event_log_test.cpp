#include "chain/events/event_log.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>
#include <vector>

namespace {

using slipfront::chain::ChainParts;
using slipfront::chain::EventLog;

/// The rupture velocity of an event in which each part of length 1 moves from its arrival on, for 100 time units.
double rupture_velocity(const std::vector<double>& arrivals, bool ring) {
  ChainParts parts;
  parts.length = 1;
  parts.ring = ring;
  for (std::size_t i = 0; i < arrivals.size(); ++i) parts.x.push_back(static_cast<double>(i));
  parts.u.resize(arrivals.size());
  parts.velocity.resize(arrivals.size());
  EventLog log(0.5);
  for (int step = -1; step < 500; ++step) {
    const double time = 0.25 * step;
    for (std::size_t i = 0; i < arrivals.size(); ++i)
      parts.velocity[i] = time >= arrivals[i] && time < 100 ? 1 + 1e-6 * (time == arrivals[i]) : 0;
    log.look(time, 0, parts);
  }
  return log.events().at(0).rupture_velocity;
}

TEST(EventLog, FitsTheVelocityOfAFront) { EXPECT_NEAR(rupture_velocity({0, 2, 4, 6, 8, 10}, false), 0.5, 1e-12); }

TEST(EventLog, FrontsRunBothWaysAroundARing) {
  const std::vector<double> arrivals = {0, 2, 4, 6, 4, 2};
  EXPECT_NEAR(rupture_velocity(arrivals, true), 0.5, 1e-12);
  EXPECT_NEAR(rupture_velocity(arrivals, false), 9.0 / 22, 1e-12);  // by the long way, as on a chain with ends
}

TEST(EventLog, PartsThatMoveFasterThanWavesHaveNoFront) {
  EXPECT_TRUE(std::isnan(rupture_velocity({0, 0.5, 1, 1.5, 2, 2.5}, false)));
  EXPECT_NEAR(rupture_velocity({0, 1, 2, 3, 4, 5}, false), 1, 1e-12);
}

/// Steps are noisy: a part that is fast for one step, in which it hardly slips, does not begin an event.
TEST(EventLog, CountsOnlyEventsThatSlip) {
  EventLog log(0.5, 1e-3);
  ChainParts parts{.x = {0}, .u = {0}, .velocity = {0}, .length = 1};
  const auto look = [&](double time, double velocity, double slip) {
    parts.velocity = {velocity};
    parts.u[0] += slip;
    log.look(time, 0, parts);
  };
  look(0, 0, 0);
  look(1, 1, 1);
  look(2, 0, 1);
  look(2.1, 1, 1e-7);
  look(2.2, 0, 1e-7);
  EXPECT_EQ(log.in_progress(), 0u);
  ASSERT_EQ(log.events().size(), 1u);
  look(5, 1, 1);
  look(6, 0, 1);
  ASSERT_EQ(log.events().size(), 2u);
  EXPECT_NEAR(log.events()[1].slip, 2, 1e-12);
}

}  // namespace
