#include "lattice/plane/direct/rows.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace {

using namespace slipfront;

/// The sine and the cosine of the substrate, and its energy, agree with those of the C++ library over many turns.
TEST(PlaneRows, HaveTheSubstrateOfASine) {
  constexpr std::size_t n = 2000;
  std::vector<double> u(n + 4), v(n), sine(n), cosine(n), contact2(n, 0.49);
  for (std::size_t i = 0; i < u.size(); ++i) u[i] = -40 + 0.04 * static_cast<double>(i);
  const double* const row = u.data() + 2;
  const plane::RowShape shape{.sites = n, .per_hx2 = 0, .per_hy2 = 0};
  for (const bool rough : {false, true}) {
    const double a2 = rough ? 0.49 : 1;
    plane::accelerate(shape, {row, row, row, row, row}, {.contact2 = rough ? contact2.data() : nullptr},
                      {v.data(), sine.data(), cosine.data()});
    double energy = 0;
    for (std::size_t i = 0; i < n; ++i) {
      EXPECT_NEAR(sine[i], a2 * std::sin(row[i]), 2e-12) << row[i];
      EXPECT_NEAR(cosine[i], a2 * std::cos(row[i]), 2e-12) << row[i];
      EXPECT_NEAR(v[i], -a2 * std::sin(row[i]), 2e-12) << row[i];
      energy += a2 * (1 - std::cos(row[i]));
    }
    EXPECT_NEAR(plane::substrate_energy(n, row, rough ? contact2.data() : nullptr) / energy, 1, 1e-12);
  }
}

/// Whatever acts on a row, the acceleration is moves (v + force).
TEST(PlaneRows, AddForcesAndHoldSites) {
  constexpr std::size_t n = 11;
  std::vector<double> u(n + 4, 0.3), a(n), v(n), sine(n), cosine(n), force(n), moves(n, 1), contact2(n, 0.49);
  for (std::size_t i = 0; i < n; ++i) force[i] = 0.1 * static_cast<double>(i);
  moves[4] = 0;
  const double* const row = u.data() + 2;
  const plane::RowShape shape{.sites = n, .per_hx2 = 1, .per_hy2 = 1};
  for (const double* contact : {static_cast<const double*>(nullptr), static_cast<const double*>(contact2.data())}) {
    plane::accelerate(shape, {row, row, row, row, row}, {.contact2 = contact}, {a.data(), sine.data(), cosine.data()});
    for (const bool loaded : {false, true})
      for (const bool held : {false, true}) {
        plane::accelerate(shape, {row, row, row, row, row},
                          {contact, loaded ? force.data() : nullptr, held ? moves.data() : nullptr},
                          {v.data(), sine.data(), cosine.data()});
        for (std::size_t i = 0; i < n; ++i)
          EXPECT_DOUBLE_EQ(v[i], (held ? moves[i] : 1) * (a[i] + (loaded ? force[i] : 0))) << i;
      }
  }
}

/// The Laplacian is exact for polynomials of fourth degree.
TEST(PlaneRows, LaplacianIsOfFourthOrder) {
  constexpr double hx = 0.1, hy = 0.2;
  const auto f = [](double x, double y) { return x * x * x * x - 2 * x * x * y + 3 * y * y * y * y + x * y; };
  std::vector<std::vector<double>> rows(5, std::vector<double>(5));
  plane::FiveRows five{};
  for (int j = 0; j < 5; ++j)
    for (int i = 0; i < 5; ++i)
      rows[static_cast<std::size_t>(j)][static_cast<std::size_t>(i)] = f(0.3 + hx * (i - 2), 0.7 + hy * (j - 2));
  for (std::size_t j = 0; j < 5; ++j) five[j] = rows[j].data() + 2;
  double result = 0;
  plane::laplacian({.sites = 1, .per_hx2 = 1 / (hx * hx), .per_hy2 = 1 / (hy * hy)}, five, &result);
  EXPECT_NEAR(result, 12 * 0.3 * 0.3 - 4 * 0.7 + 36 * 0.7 * 0.7, 1e-10);
}

}  // namespace
