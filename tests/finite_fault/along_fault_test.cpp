#include "events/finite_fault/along_fault.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

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

/// The slope of the rupture times of the eight subfaults that are nearest to `here`, found among all.
double slowness_by_search(const LocalState& here, std::vector<LocalState> all) {
  const auto distance = [&](const LocalState& s) {
    return std::hypot(s.along_strike - here.along_strike, s.down_dip - here.down_dip);
  };
  std::sort(all.begin(), all.end(), [&](const auto& a, const auto& b) { return distance(a) < distance(b); });
  double aa = 0, ab = 0, bb = 0, at = 0, bt = 0;
  for (std::size_t k = 1; k <= 8; ++k) {
    const double a = all[k].along_strike - here.along_strike, b = all[k].down_dip - here.down_dip;
    const double t = *all[k].subfault.rupture_time - *here.subfault.rupture_time;
    aa += a * a, ab += a * b, bb += b * b, at += a * t, bt += b * t;
  }
  return std::hypot(at * bb - bt * ab, bt * aa - at * ab) / (aa * bb - ab * ab);
}

/// Subfaults that are long along strike or down dip, at no equal distances, in the order of no direction.
TEST(AlongFault, FitsTheEightNearestSubfaults) {
  for (const double length : {3000.0, 1000.0, 300.0}) {
    Observation o;
    o.name = "curved front";
    for (int n = 0; n < 91; ++n) {
      const int k = n * 34 % 91, i = k % 13, j = k / 13;
      const double x = length * (i + 0.1 * std::sin(7.0 * k)), z = 1000 * (j + 0.1 * std::cos(5.0 * k));
      o.subfaults.push_back({.x = x, .z = 500 + z, .slip = 1, .rupture_time = std::hypot(x - 2000, z - 3000) / 2500});
    }
    const std::vector<LocalState> states = along_fault(o, {});
    for (const LocalState& s : states) EXPECT_NEAR(*s.rupture_velocity_m_s * slowness_by_search(s, states), 1, 1e-9);
  }
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
