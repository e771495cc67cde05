#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "error_metric.hpp"
#include "reference_table.hpp"
#include "slipfront/error.hpp"
#include "slipfront/math/elliptic.hpp"

namespace {

using namespace slipfront::elliptic;

TEST(Complete, MatchesTheTableToFourUlp) {
  for (const auto& row : reference_table("complete.csv")) {
    const Complete c = complete(row["m1"]);
    EXPECT_LE(error_in_eps(c.K, row["K"]), 4) << "m1 = " << row.text("m1");
    EXPECT_LE(error_in_eps(c.E, row["E"]), 4) << "m1 = " << row.text("m1");
  }
}

/// Legendre's relation E K' + E' K - K K' = pi / 2 is a test that needs no table.
TEST(Complete, SatisfiesLegendresRelation) {
  for (double m1 = 0.01; m1 < 1; m1 += 0.01) {
    const Complete a = complete(m1), b = complete(1 - m1);
    EXPECT_NEAR(a.E * b.K + b.E * a.K - a.K * b.K, std::numbers::pi / 2, 2e-15) << m1;
  }
}

TEST(Complete, RejectsInvalidComplementaryParameters) {
  for (const double bad : {0.0, -1e-300, 1.0000001, std::nan(""), HUGE_VAL})
    EXPECT_THROW(complete(bad), slipfront::InputError) << bad;
  for (const double bad : {0.0, -1.0, std::nan("")}) EXPECT_THROW(at_psi(bad), slipfront::InputError) << bad;
}

TEST(AtPsi, MatchesTheTableOverAllDensities) {
  for (const auto& row : reference_table("psi.csv")) {
    const AtPsi at = at_psi(row["psi"]);
    EXPECT_LE(error_in_eps(at.K, row["K"]), 4) << "psi = " << row.text("psi");
    EXPECT_LE(error_in_eps(at.E, row["E"]), 4) << "psi = " << row.text("psi");
    EXPECT_LE(error_in_eps(at.excess / at.ratio, row["one_minus_c0"]), 8) << "psi = " << row.text("psi");
  }
}

TEST(AtPsi, DifferencesMatchTheirDefinitions) {
  for (const double psi : {1e-12, 1e-6, 0.01, 0.1, 0.2, 0.5, 1.0}) {
    const AtPsi at = at_psi(psi);
    EXPECT_NEAR(at.ratio, at.E / at.K, 1e-15);
    EXPECT_NEAR(at.excess, at.E / at.K - at.s, 1e-15);
    EXPECT_NEAR(at.deficit, 1 - at.E / at.K, 1e-15);
    EXPECT_NEAR(at.above_m1, at.E / at.K - at.s * at.s, 1e-15);
  }
}

/// Expects that the fields on both sides of a switch agree, up to a relative difference of `eps` machine epsilons.
void expect_same(const AtPsi& a, const AtPsi& b, double eps) {
  EXPECT_LE(error_in_eps(a.K, b.K), eps);
  EXPECT_LE(error_in_eps(a.E, b.E), eps);
  EXPECT_LE(error_in_eps(a.s, b.s), eps);
  EXPECT_LE(error_in_eps(a.ratio, b.ratio), eps);
  EXPECT_LE(error_in_eps(a.excess, b.excess), eps);
  EXPECT_LE(error_in_eps(a.deficit, b.deficit), eps);
  EXPECT_LE(error_in_eps(a.above_m1, b.above_m1), eps);
}

TEST(AtPsi, IsContinuousAtTheSwitchesBetweenFormulas) {
  const double up = 1 + 1e-12;  // steps from one side of a switch to the other
  expect_same(at_psi_empty(psi_empty_below * up), at_psi(psi_empty_below * up), 8);
  expect_same(at_psi_empty(psi_empty_below / up), at_psi(psi_empty_below / up), 0);
  expect_same(at_psi_dense(psi_dense_above / up), at_psi(psi_dense_above / up), 8);
  expect_same(at_psi_dense(psi_dense_above * up), at_psi(psi_dense_above * up), 0);
  const double series_switch = std::atanh(0.125);  // from logarithmic series to arithmetic-geometric mean
  expect_same(at_psi(series_switch * (1 - 1e-16)), at_psi(series_switch * (1 + 4e-16)), 24);
}

}  // namespace
