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

}  // namespace
