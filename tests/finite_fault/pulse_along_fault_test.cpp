#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "events/finite_fault/along_fault.hpp"
#include "slipfront/theory/rupture/relations.hpp"

namespace {

using namespace slipfront;
using namespace slipfront::finite_fault;

constexpr double speed = 5000;  // c
constexpr int columns = 21, rows = 4;

/// A vertical fault along x. Its rupture runs from column `start` at `velocity`, and column i slips by slip(i).
template <class Slip>
std::vector<LocalState> fault(int start, double velocity, const Slip& slip) {
  std::vector<LocalState> states;
  for (int i = 0; i < columns; ++i)
    for (int j = 0; j < rows; ++j) {
      LocalState s;
      s.along_strike = 2000.0 * (i - columns / 2) + 3 * j;  // subfaults of a column differ slightly
      s.subfault = {.x = s.along_strike,
                    .z = 1000.0 * j,
                    .slip = slip(i),
                    .rise_time = 1,
                    .rupture_time = 2000.0 * std::abs(i - start) / velocity};
      states.push_back(s);
    }
  return states;
}

/// With uniform slip, the front has the velocity of the closed form, and the slip follows from the step at the
/// hypocentre (Eqs. 8-10).
TEST(PulseAlongFault, HasTheVelocityOfTheClosedFormForUniformSlip) {
  const rupture::Relations r = rupture::from_stress(0.9);
  const double velocity = r.rupture_velocity * speed;
  const FaultPulse p = pulse_along_fault(fault(7, velocity, [](int) { return 1.5; }), 0.9, speed);
  ASSERT_EQ(p.reason, "");
  ASSERT_EQ(p.x.size(), 21u);
  EXPECT_NEAR(*p.front_velocity_ratio, 1, 1e-6);
  EXPECT_EQ(p.reached, 21u);
  for (std::size_t i = 0; i < p.x.size(); ++i) {
    EXPECT_NEAR(p.stress[i], 0.9, 1e-12);
    EXPECT_NEAR(*p.front_time[i], std::fabs(p.x[i]) / velocity, 1e-4);
    EXPECT_NEAR(*p.model_time[i], std::fabs(p.x[i]) / velocity, 1e-3);
  }
  // At the hypocentre the slip velocity is W(0) c A / pi from the first moment on.
  EXPECT_NEAR(p.pulse_slip[7], r.slip_velocity * *p.contact_ratio * speed / M_PI * p.end, 2e-3 * p.pulse_slip[7]);
  EXPECT_NEAR(p.pulse_slip[5], p.pulse_slip[9], 1e-2 * p.pulse_slip[7]);  // equal on both sides
}

/// The front slows down where the slip is smaller. Ahead of it, the load holds the nonuniform stress at rest.
TEST(PulseAlongFault, HoldsNonuniformStressUntilTheFrontArrives) {
  const auto slip = [](int i) { return 1 + 0.5 * std::sin(0.9 * i); };
  const FaultPulse p = pulse_along_fault(fault(10, 20000, slip), 0.9, speed);
  ASSERT_EQ(p.reason, "");
  EXPECT_GT(p.reached, 1u);
  EXPECT_LT(p.reached, 12u);
  EXPECT_LT(*p.slip_error, 0.01);
  const double lengths = p.x[15] - p.x[14];
  for (std::size_t i = 11; i + 1 < p.x.size(); ++i) {
    const double velocity = lengths / (*p.front_time[i + 1] - *p.front_time[i]);
    const auto [low, high] = std::minmax(p.stress[i], p.stress[i + 1]);
    EXPECT_GT(velocity, rupture::from_stress(low).rupture_velocity * speed * 0.999);
    EXPECT_LT(velocity, rupture::from_stress(high).rupture_velocity * speed * 1.001);
  }
}

TEST(PulseAlongFault, StopsWhereTheStressIsZero) {
  const FaultPulse p = pulse_along_fault(fault(10, 2000, [](int i) { return i == 14 ? 0.0 : 1.0; }), 0.9, speed);
  ASSERT_EQ(p.reason, "");
  EXPECT_EQ(p.stress[14], 0);
  EXPECT_TRUE(p.front_time[13]);
  for (std::size_t i = 14; i < p.x.size(); ++i) EXPECT_FALSE(p.front_time[i]);
  EXPECT_TRUE(p.front_time[0]);
  EXPECT_FALSE(p.model_time[14]);
}

TEST(PulseAlongFault, StartsFromAnEndOfTheFault) {
  const FaultPulse p = pulse_along_fault(fault(0, 2000, [](int) { return 1.0; }), 0.9, speed);
  EXPECT_EQ(p.x.front(), 0);
  EXPECT_GT(p.pulse_slip[0], p.pulse_slip[3]);
  EXPECT_GT(p.pulse_slip[3], 0);
}

TEST(PulseAlongFault, ScalesStressWithSlip) {
  EXPECT_NEAR(stress_by_slip(0.9, 1), 0.9, 1e-12);
  const double half = rupture::from_stress(stress_by_slip(0.9, 0.5)).slip_velocity;
  EXPECT_NEAR(half, rupture::from_stress(0.9).slip_velocity / 2, 1e-12);
  EXPECT_EQ(stress_by_slip(0.9, 0), 0);
  EXPECT_EQ(stress_by_slip(0.006, 1e-300), 0);
  EXPECT_EQ(stress_by_slip(0.9, 1e9), 5);
}

TEST(PulseAlongFault, GivesTheReasonIfTheModelIsUnsuitable) {
  const auto reason = [](const std::vector<LocalState>& states) {
    return pulse_along_fault(states, 0.9, speed).reason;
  };
  const auto one = [](int) { return 1.0; };
  EXPECT_NE(reason({}).find("no positions"), std::string::npos);
  std::vector<LocalState> states = fault(10, 2000, one);
  states.resize(2 * rows);
  EXPECT_NE(reason(states).find("2 columns"), std::string::npos);
  for (LocalState& s : states) s.subfault.rupture_time = 3;
  EXPECT_NE(reason(states).find("equal"), std::string::npos);
  for (LocalState& s : states) s.subfault.rupture_time.reset();
  EXPECT_NE(reason(states).find("TRUP"), std::string::npos);
  states = fault(10, 2000, one);
  for (std::size_t i = 0; i < states.size(); ++i) states[i].along_strike += 700 * static_cast<double>(i % rows);
  EXPECT_NE(reason(states).find("columns along strike"), std::string::npos);
  EXPECT_NE(reason(fault(10, 2000, [](int) { return 0.0; })).find("TRUP"), std::string::npos);
}

}  // namespace
