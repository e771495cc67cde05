// Springs of fourth order: their linear equations, and their energy in waves.

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "lattice/chain/implicit/compact_springs.hpp"

namespace {

using namespace slipfront;
using chain::CompactSprings;
using chain::Tridiagonal;

TEST(Tridiagonal, SolvesItsEquations) {
  constexpr std::size_t n = 9;
  for (const bool cyclic : {false, true}) {
    Tridiagonal matrix(n);
    std::vector<double> x, right;
    for (std::size_t i = 0; i < n; ++i) {
      const auto at = static_cast<double>(i);
      matrix.below[i] = !cyclic && i == 0 ? 0 : 0.3 + 0.1 * std::sin(at);
      matrix.above[i] = !cyclic && i + 1 == n ? 0 : 0.4 * std::cos(at);
      matrix.diagonal[i] = 1.5 + 0.2 * std::cos(3 * at);
      x.push_back(std::sin(2 * at + 1));
    }
    for (std::size_t i = 0; i < n; ++i)
      right.push_back(matrix.below[i] * x[(i + n - 1) % n] + matrix.diagonal[i] * x[i] +
                      matrix.above[i] * x[(i + 1) % n]);
    matrix.solve(right, cyclic, Ranks::single());
    for (std::size_t i = 0; i < n; ++i) EXPECT_NEAR(right[i], x[i], 1e-14) << i;
  }
}

/// A string with the slope c has the energy c^2 / 2 of each unit of length, also under a standing wave.
TEST(CompactSprings, HaveTheEnergyOfAnInclinedString) {
  constexpr std::size_t sites = 41;
  constexpr double h = 0.25, height = 0.01;
  const double pi = std::acos(-1.0);
  for (const chain::Model model : {chain::Model::lattice, chain::Model::sine_gordon})
    for (const bool ring : {false, true}) {
      chain::Problem p;
      p.model = model;
      p.grid = {0, h, sites};
      p.boundary = {chain::End::fixed, chain::End::fixed, ring, ring ? 1 : 0};
      const double length = ring ? sites * h : (sites - 1) * h, slope = -2 * pi / length;
      std::vector<double> wave, inclined;
      for (std::size_t j = 0; j < sites; ++j) {
        const double x = h * static_cast<double>(j);
        wave.push_back(height * std::sin(2 * pi * x / length));
        inclined.push_back(wave[j] + slope * x);
      }
      wave.back() = ring ? wave.back() : 0;
      chain::Problem level = p;
      level.boundary.charge = 0;
      const double of_wave = CompactSprings(level, wave, Ranks::single()).energy(wave);
      const double energy = CompactSprings(p, inclined, Ranks::single()).energy(inclined);
      EXPECT_NEAR(energy - of_wave, slope * slope / 2 * length, 1e-11) << ring;
    }
}

/// A standing wave has the energy of its force, whose ratio to u is known: (2 cos kh - 2) / h^2, over 1 + 1/12 of its
/// numerator for the scheme of fourth order.
TEST(CompactSprings, HaveTheEnergyOfStandingWaves) {
  constexpr std::size_t sites = 41;
  constexpr double h = 0.25, height = 0.01;
  const double pi = std::acos(-1.0);
  for (const chain::Model model : {chain::Model::lattice, chain::Model::sine_gordon})
    for (const bool fixed : {false, true})
      for (const bool ring : {false, true}) {
        chain::Problem p;
        p.model = model;
        p.grid = {0, h, sites};
        const chain::End end = fixed ? chain::End::fixed : chain::End::free;
        p.boundary = {end, end, ring, 0};
        const double k = ring ? 6 * pi / (sites * h) : 3 * pi / ((sites - 1) * h);
        std::vector<double> u;
        for (std::size_t j = 0; j < sites; ++j) {
          const double phase = k * h * static_cast<double>(j);
          u.push_back(height * (fixed ? std::sin(phase) : std::cos(phase)));
        }
        u.back() = fixed && !ring ? 0 : u.back();
        const double second = 2 * std::cos(k * h) - 2,
                     ratio = second / (h * h) / (model == chain::Model::lattice ? 1 : 1 + second / 12);
        const double length = ring ? sites * h : (sites - 1) * h;
        const double energy = -height * height / 4 * length * ratio;
        const CompactSprings springs(p, u, Ranks::single());
        EXPECT_NEAR(springs.energy(u) / energy, 1, 1e-12) << fixed << ring;
      }
}

}  // namespace
