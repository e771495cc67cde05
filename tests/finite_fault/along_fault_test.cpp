#include "events/finite_fault/along_fault.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "slipfront/theory/rupture/relations.hpp"

namespace {

using namespace slipfront;
using namespace slipfront::catalogue;
using namespace slipfront::finite_fault;

/// A fault that strikes north-east and dips 40 degrees, ruptured by a plane front.
TEST(AlongFault, FindsThePlaneFront) {
  constexpr double speed = 2500, dip = 0.7, direction = 0.5;
  Observation o;
  o.name = "plane front";
  for (int i = 0; i < 12; ++i)
    for (int j = 0; j < 6; ++j) {
      const double along = 2000.0 * i, down = 1500.0 * j, across = down * std::cos(dip);
      o.subfaults.push_back({.x = (along - across) / std::sqrt(2),
                             .y = (along + across) / std::sqrt(2),
                             .z = 1000 + down * std::sin(dip),
                             .slip = 1.5,
                             .rise_time = 3,
                             .rupture_time = (along * std::cos(direction) + down * std::sin(direction)) / speed});
    }
  const std::vector<LocalState> states = along_fault(o, {});
  ASSERT_EQ(states.size(), 72u);
  const rupture::Relations r = rupture::from_rupture_velocity(speed / 5421.047417);
  for (const LocalState& s : states) {
    ASSERT_TRUE(s.rupture_velocity_m_s && s.stress && s.stress_pa);
    EXPECT_NEAR(*s.rupture_velocity_m_s, speed, 1e-6 * speed);
    EXPECT_NEAR(*s.stress, r.stress, 1e-6);
    EXPECT_NEAR(*s.slip_velocity_m_s, 0.5, 1e-15);
  }
  EXPECT_NEAR(std::fabs(states.back().along_strike - states.front().along_strike), 22000, 1e-6);
  EXPECT_NEAR(states.back().down_dip - states.front().down_dip, 7500, 1e-6);
}

TEST(AlongFault, LeavesMissingQuantitiesAbsent) {
  Observation o;
  o.name = "no times";
  for (int i = 0; i < 5; ++i) o.subfaults.push_back({.x = 1000.0 * i, .z = 500, .slip = 1});
  for (const LocalState& s : along_fault(o, {}))
    EXPECT_FALSE(s.rupture_velocity_m_s || s.stress || s.slip_velocity_m_s);
  for (Subfault& s : o.subfaults) s.rupture_time = 1;  // all at once
  for (const LocalState& s : along_fault(o, {})) EXPECT_FALSE(s.rupture_velocity_m_s);
  o.subfaults.clear();
  EXPECT_TRUE(along_fault(o, {}).empty());
}

}  // namespace
