#include "../../src/pulse/branch_free.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "../../src/pulse/kernels.hpp"
#include "error_metric.hpp"
#include "slipfront/modulation/per_dislocation.hpp"

namespace {

using namespace slipfront::pulse;

TEST(BranchFree, IsTheStandardLibraryToAFewUlp) {
  for (double x = 1e-300; x < 300; x *= 1.37) {
    EXPECT_LE(error_in_eps(log1p_branch_free(x), std::log1p(x)), 3) << x;
    for (const double signed_x : {x, -x}) {
      EXPECT_LE(error_in_eps(expm1_branch_free(signed_x), std::expm1(signed_x)), 4) << signed_x;
      EXPECT_LE(error_in_eps(asinh_branch_free(signed_x), std::asinh(signed_x)), 4) << signed_x;
      EXPECT_LE(error_in_eps(tanh_branch_free(signed_x), std::tanh(signed_x)), 5) << signed_x;
      EXPECT_LE(error_in_eps(sinh_branch_free(signed_x), std::sinh(signed_x)), 5) << signed_x;
    }
    if (x < 0.999) {
      EXPECT_LE(error_in_eps(atanh_branch_free(x), std::atanh(x)), 5) << x;
    }
  }
  EXPECT_EQ(log1p_branch_free(0), 0);
  EXPECT_EQ(tanh_branch_free(0), 0);
}

/// The vector route agrees with the scalar one, and says so where it cannot.
TEST(Kernels, ResolveAllIsResolve) {
  for (const double phi : {-1.5, 0.0, 1e-7, 0.4})
    for (double psi = 1e-12; psi < 3; psi *= 1.9) {
      const auto c = slipfront::modulation::carried({phi, psi});
      double s = std::tanh(psi) * 1.05, got_phi = 0, got_psi = 0, sound = 0, EK = 0, good = 0;
      resolve_all({1, &c.spacing, &c.momentum, &s, &got_phi, &got_psi, &sound, &EK, &good});
      const auto want = slipfront::modulation::resolve(c, psi);
      if (psi > 1e-9 && psi < 0.8 && std::fabs(phi) < 1) {
        EXPECT_EQ(good, 1) << phi << " " << psi;
      }
      if (psi < 0.9e-10 || psi > 1.6) {
        EXPECT_EQ(good, 0) << phi << " " << psi;
      }
      if (good == 0) continue;
      const double condition = 1 + std::fabs(std::log(psi));
      EXPECT_NEAR(got_psi / want.state.psi, 1, 1e-10) << phi << " " << psi;
      EXPECT_NEAR(got_phi, want.state.phi, 1e-14 * condition + 1e-10 * std::fabs(phi) * psi) << phi << " " << psi;
      EXPECT_NEAR(sound / want.sound_speed, 1, 1e-9) << phi << " " << psi;
      EXPECT_NEAR(EK / want.EK, 1, 1e-10) << phi << " " << psi;
    }
}

}  // namespace
