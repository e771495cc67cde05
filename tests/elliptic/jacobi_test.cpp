#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "error_metric.hpp"
#include "reference_table.hpp"
#include "slipfront/error.hpp"
#include "slipfront/math/elliptic.hpp"

namespace {

using namespace slipfront::elliptic;

TEST(Jacobi, MatchesTheTable) {
  for (const auto& row : reference_table("jacobi.csv")) {
    const double m1 = row["m1"], z = row["z"];
    const Jacobi f = jacobi(z, m1);
    const std::string where = "m1 = " + row.text("m1") + ", z = " + row.text("z");
    // The rounding error of z is eps |z|. It changes sn, cn and dn in proportion to their derivatives.
    const double K = complete(m1).K;
    const double slack = 8 + 4 * std::fabs(z) + 2 * K;
    const auto within = [&](double got, double want, double slope) {
      EXPECT_LE(std::fabs(got - want), DBL_EPSILON * (8 * std::fabs(want) + slack * std::fabs(slope))) << where;
    };
    within(f.am, row["am"], row["dn"]);
    if (z >= 0 && z < K) {
      within(std::sin(f.coamplitude), row["cn"], row["sn"] * row["dn"]);
    } else {
      EXPECT_NEAR(f.coamplitude, std::numbers::pi / 2 - row["am"],
                  DBL_EPSILON * (slack * row["dn"] + 4 * std::fabs(row["am"])))
          << where;
    }
    within(f.sn, row["sn"], row["cn"] * row["dn"]);
    within(f.cn, row["cn"], row["sn"] * row["dn"]);
    within(f.dn, row["dn"], (1 - m1) * row["sn"] * row["cn"]);
    if (std::fabs(z) < 0.99 * K) {  // a relative error, also for tiny values
      EXPECT_LE(error_in_eps(f.dn, row["dn"]), slack) << where;
    }
  }
}

TEST(Jacobi, SatisfiesItsIdentities) {
  for (const double m1 : {1e-30, 1e-17, 1e-15, 1e-6, 0.02, 0.4, 0.999, 1.0})
    for (double z = -7; z < 7; z += 0.37) {
      const Jacobi f = jacobi(z, m1);
      EXPECT_NEAR(f.sn * f.sn + f.cn * f.cn, 1, 4e-15);
      EXPECT_NEAR(f.dn * f.dn, m1 + (1 - m1) * f.cn * f.cn, 4e-15);
      EXPECT_NEAR(f.sn, std::sin(f.am), 4e-15);
      EXPECT_NEAR(f.cn, std::sin(f.coamplitude), 4e-15);
    }
}

TEST(Jacobi, IsContinuousAtTheSwitchToHyperbolicFunctions) {
  const double s = 1e-8;  // sqrt(m1) at the switch
  const double below = s * s * (1 - 1e-12), above = s * s * (1 + 1e-12);
  const double K = complete(s * s).K;
  for (const double part : {0.01, 0.2, 0.45, 0.499, 0.501, 0.7, 0.9}) {
    const Jacobi a = jacobi(part * K, below), b = jacobi(part * K, above);
    EXPECT_LE(error_in_eps(a.cn, b.cn), 2e4) << part;  // m1 differs by 1e-12, about 1e4 eps
    EXPECT_LE(error_in_eps(a.dn, b.dn), 2e4) << part;
  }
}

TEST(Jacobi, ResolvesSmallDnBetweenDistantKinks) {
  const AtPsi at = at_psi(1e-200);
  EXPECT_LE(error_in_eps(jacobi(at.K, at).dn, 1e-200), 4);
  EXPECT_THROW(jacobi(HUGE_VAL, at), slipfront::InputError);
}

}  // namespace
