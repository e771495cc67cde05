#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "slipfront/error.hpp"
#include "slipfront/friction/ratio/table.hpp"

namespace {

using namespace slipfront;
using namespace slipfront::friction_ratio;
using friction::Closure;

TEST(DampingNumber, InvertsTheTable) {
  for (const Closure closure : {Closure::consistent, Closure::paper})
    for (const double stress : {0.05, 0.21, 0.855, 3.0})
      for (const double damping : {1e-3, 0.63, 3.14, 12.6, 4e3, 1e6, 1e10})
        for (const SlipVelocityKind measure : {SlipVelocityKind::origin, SlipVelocityKind::time_mean}) {
          const Ratio at = evaluate(measure, closure, stress, damping);
          EXPECT_NEAR(damping_number(measure, closure, stress, at.value).damping_number / damping, 1, 1e-9)
              << stress << " " << damping << " " << name_of(measure);
        }
}

/// The stated error is the shift of the damping number that the uncertainty of the table causes.
TEST(DampingNumber, ErrorCoversTheUncertaintyOfTheTable) {
  for (const Closure closure : {Closure::consistent, Closure::paper})
    for (const double damping : {0.5, 5.0, 2e5}) {
      const Ratio at = evaluate(SlipVelocityKind::origin, closure, 0.855, damping);
      const double share = uncertainty(closure, damping);
      const Reading reading = damping_number(SlipVelocityKind::origin, closure, 0.855, at.value);
      const double moved =
          damping_number(SlipVelocityKind::origin, closure, 0.855, at.value * (1 - share)).damping_number;
      EXPECT_NEAR((moved - damping) / reading.error, 1, 0.05);
    }
}

TEST(DampingNumber, RejectsRatiosThatFrictionCannotCause) {
  for (const double ratio : {0.0, -0.1, 1.001, 1e-200, std::numeric_limits<double>::quiet_NaN()})
    EXPECT_THROW(damping_number(SlipVelocityKind::origin, Closure::consistent, 0.855, ratio), InputError) << ratio;
  EXPECT_EQ(damping_number(SlipVelocityKind::origin, Closure::consistent, 0.855, 1).damping_number, 0);
  const double most = evaluate(SlipVelocityKind::mean, Closure::consistent, 0.855, 0).value;
  EXPECT_THROW(damping_number(SlipVelocityKind::mean, Closure::consistent, 0.855, most * 1.01), InputError);
  EXPECT_THROW(damping_number(SlipVelocityKind::origin, Closure::consistent, 4, 0.5), InputError);
}

}  // namespace
