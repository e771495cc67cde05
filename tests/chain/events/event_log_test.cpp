#include "lattice/chain/events/event_log.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>
#include <cstdlib>
#include <vector>

#include "slipfront/error.hpp"
#include "system/archive.hpp"

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
  EXPECT_NEAR(rupture_velocity(arrivals, false), 0.5, 1e-12);  // on a chain with ends they run from both ends
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

/// A chain of 24 parts of length 1 that moves with the velocities `velocity_at`.
struct MovingParts {
  ChainParts parts;
  EventLog log{0.5};

  explicit MovingParts(double stiffness) {
    parts.length = 1;
    parts.stiffness.assign(24, stiffness);
    for (int i = 0; i < 24; ++i) parts.x.push_back(i);
    parts.u.assign(24, 0);
    parts.velocity.assign(24, 0);
  }
  /// Moves to `end`. The load is that of springs whose ends are at rest.
  template <class Velocity>
  void move_to(double end, const Velocity& velocity_at) {
    constexpr double step = 0.125;
    for (; time < end; time += step) {
      double sum = 0;
      for (std::size_t i = 0; i < 24; ++i) {
        parts.velocity[i] = velocity_at(static_cast<int>(i), time);
        parts.u[i] += step * parts.velocity[i];
        sum += parts.stiffness[i] * parts.u[i];
      }
      log.look(time, 100 - sum / 24, parts);
    }
  }
  double time = 0;
};

/// Fronts with the velocity 1/2 from the parts 4 and 20 run 2 parts far. Each event has its own slip and stress drop,
/// though they overlap in time.
TEST(EventLog, DistantPatchesAreTwoEvents) {
  MovingParts chain(3);
  std::fill(chain.parts.stiffness.begin() + 12, chain.parts.stiffness.end(), 5.0);
  const auto two_patches = [](int i, double t) {
    const int left = std::abs(i - 4), right = std::abs(i - 20);
    const bool in_left = left <= 2 && t >= 10 + 2 * left && t < 30,
               in_right = right <= 2 && t >= 11 + 2 * right && t < 25;
    return in_left ? 1.0 : in_right ? 2.0 : 0.0;
  };
  chain.move_to(20, two_patches);
  EXPECT_EQ(chain.log.in_progress(), 2u);
  EXPECT_EQ(chain.log.event_at(3), chain.log.identities()[0]);
  EXPECT_EQ(chain.log.event_at(17), chain.log.identities()[1]);  // next to its last part
  EXPECT_EQ(chain.log.event_at(12), 0u);
  chain.move_to(40, two_patches);
  EXPECT_EQ(chain.log.in_progress(), 0u);
  const auto& events = chain.log.events();
  ASSERT_EQ(events.size(), 2u);
  const double slips[2] = {20.0 + 2 * 18 + 2 * 16, 2 * (14.0 + 2 * 12 + 2 * 10)}, durations[2] = {20, 14};
  for (const std::size_t n : {0u, 1u}) {
    EXPECT_EQ(events[n].origin, n == 0 ? 4 : 20);
    EXPECT_EQ(events[n].onset, n == 0 ? 10 : 11);
    EXPECT_EQ(events[n].duration, durations[n]);
    EXPECT_EQ(events[n].length, 5);
    EXPECT_NEAR(events[n].slip, slips[n] / 24, 1e-12);
    EXPECT_NEAR(events[n].stress_drop, (n == 0 ? 3 : 5) * slips[n] / 24, 1e-11);
    EXPECT_EQ(events[n].peak_velocity, n == 0 ? 1 : 2);
    EXPECT_NEAR(events[n].rupture_velocity, 0.5, 0.06);
    EXPECT_EQ(events[n].complete, 1);
    EXPECT_EQ(events[n].merged, 0);
  }
}

/// Fronts from the parts 4 and 12 meet. They become the first event, with the slip of both, and leave no other.
TEST(EventLog, EventsThatMeetAreOne) {
  MovingParts chain(3);
  const auto meeting = [](int i, double t) {
    const int left = std::abs(i - 4), right = std::abs(i - 12);
    return left <= 4 && t >= 10 + 2 * left && t < 30 ? 1.0 : right <= 4 && t >= 11 + 2 * right && t < 30 ? 1.0 : 0.0;
  };
  chain.move_to(14, meeting);
  EXPECT_EQ(chain.log.events().size(), 2u);
  chain.move_to(40, meeting);
  ASSERT_EQ(chain.log.events().size(), 1u);
  const auto& event = chain.log.events()[0];
  EXPECT_EQ(event.origin, 4);
  EXPECT_EQ(event.length, 17);
  EXPECT_EQ(event.duration, 20);
  EXPECT_EQ(event.merged, 1);
  double sum = 0;
  for (const double u : chain.parts.u) sum += u;
  EXPECT_NEAR(event.slip, sum / 24, 1e-12);
  EXPECT_NEAR(event.stress_drop, 3 * sum / 24, 1e-11);
}

/// A pulse whose parts stop when the next one begins stays one event.
TEST(EventLog, APulseOfOnePartIsOneEvent) {
  MovingParts chain(0);
  chain.move_to(60, [](int i, double t) { return t >= 5 + 2 * i && t < 7 + 2 * i ? 1.0 : 0.0; });
  ASSERT_EQ(chain.log.events().size(), 1u);
  EXPECT_EQ(chain.log.events()[0].length, 24);
  EXPECT_NEAR(chain.log.events()[0].rupture_velocity, 0.5, 1e-9);
}

/// Which part is the first of a block that slips all at once depends on rounding, so it has no origin.
TEST(EventLog, ABlockThatSlipsAtOnceHasNoOrigin) {
  MovingParts chain(0);
  chain.move_to(20, [](int i, double t) { return t >= 5 && t < 7 ? 1.0 + 1e-14 * (i == 11) : 0.0; });
  ASSERT_EQ(chain.log.events().size(), 1u);
  EXPECT_TRUE(std::isnan(chain.log.events()[0].origin));
  EXPECT_TRUE(std::isnan(chain.log.events()[0].rupture_velocity));
}

/// Events in progress, of which two meet later, continue to the same bits.
TEST(EventLog, ContinuesToTheSameBits) {
  const auto moving = [](int i, double t) {
    return t >= 10 + 2 * std::abs(i - 4) || t >= 10.3 + 2 * std::abs(i - 20) ? std::exp(-t / 9) * 4 : 1e-3 * i;
  };
  MovingParts whole(3), first(3);
  whole.move_to(40, moving);
  first.move_to(15, moving);
  EXPECT_EQ(first.log.events().size(), 2u);
  MovingParts second = first;
  second.log = EventLog(0.5);
  slipfront::restore(second.log, slipfront::saved(first.log));
  second.move_to(40, moving);
  EXPECT_EQ(slipfront::saved(second.log), slipfront::saved(whole.log));
  std::string cut = slipfront::saved(first.log);
  cut.pop_back();
  EXPECT_THROW(slipfront::restore(second.log, cut), slipfront::InputError);
}

}  // namespace
