#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "lattice/chain/explicit/levels/kernel.hpp"
#include "lattice/chain/explicit/levels/scheme.hpp"
#include "lattice/chain/implicit/implicit_chain.hpp"

namespace {

namespace chains = slipfront::chain;

constexpr std::size_t begins[] = {8, 16, 32, 40, 75}, blocks = 4, sites = 67, room = 72;

/// The sums should be those of their definition: all sites of a block count, also those that do not fill a vector, and
/// the sites at the ends of a chain by half.
template <class Term>
void expect_sums(const std::vector<double>& sums, const Term& term, double tolerance) {
  for (std::size_t i = 0; i < blocks; ++i) {
    double sum = 0;
    for (std::size_t j = begins[i] - 8; j < begins[i + 1] - 8; ++j)
      sum += j == 0 || j + 1 == sites ? term(j) / 2 : term(j);
    for (std::size_t k = 0; k < chains::lanes; ++k) sum -= sums[chains::lanes * i + k];
    EXPECT_NEAR(sum, 0, tolerance) << i;
  }
}

struct SomeSums {
  std::vector<double> sums = std::vector<double>(blocks * chains::lanes);
  chains::BlockSums to{begins, blocks, sums.data(), chains::lanes, 0, true, true};
};

TEST(ChainKernels, SumOverAllSitesOfTheirBlocks) {
  std::vector<double> a(room), b(room), c(room);
  for (std::size_t j = 0; j < room; ++j) {
    const auto x = static_cast<double>(j);
    a[j] = (j % 2 == 0 ? 1 : -1) * std::sqrt(x + 1);
    b[j] = std::cos(0.3 * x);
    c[j] = std::exp(-0.1 * x);
  }
  SomeSums values, products, works;
  chains::add_values(values.to, 2, a.data());
  expect_sums(
      values.sums, [&](std::size_t j) { return 2 * a[j]; }, 1e-12);
  chains::add_products(products.to, 0.5, a.data(), b.data());
  expect_sums(
      products.sums, [&](std::size_t j) { return 0.5 * a[j] * b[j]; }, 1e-12);
  // Six terms, as a force that is the sum of six.
  const chains::ForceTerms F{.count = 6, .X = {a.data(), b.data(), c.data(), c.data(), b.data(), a.data()}};
  const chains::ForceTerms::Weights of_D{1, 2, 3, 4, 5, 6}, of_B{0.3, -0.2, 0.1, 0.2, 0.4, -0.5};
  chains::add_works(works.to, 2, F, of_D, of_B, b.data(), c.data());
  expect_sums(
      works.sums,
      [&](std::size_t j) {
        const double now = 7 * a[j] + 7 * b[j] + 7 * c[j], rate = -0.2 * a[j] + 0.2 * b[j] + 0.3 * c[j];
        return 2 * (now * b[j] + rate * (b[j] - c[j]));
      },
      1e-12);
}

/// The squares are the integrals of the square of a rate that is linear in time over each step.
TEST(ChainKernels, MeasureStepsOfAllSites) {
  const auto u_at = [](std::size_t j, int level) { return std::sin(0.1 * static_cast<double>(j) + 0.7 * level); };
  const auto D_at = [&](std::size_t j, int level) { return u_at(j, level) - u_at(j, level - 1); };
  for (const auto what : {chains::Measured::only_absolutes, chains::Measured::absolutes, chains::Measured::squares,
                          chains::Measured::only_cubes}) {
    SomeSums measured;
    std::vector<double> u(room), D(room), next(room), rest(room), y(room);
    for (std::size_t j = 0; j < room; ++j) {
      u[j] = u_at(j, 0);
      D[j] = D_at(j, 0);
    }
    const bool squares = what == chains::Measured::squares, cubes = what == chains::Measured::only_cubes;
    const double factor = 1.5;
    for (int level = 1; level < 4; ++level) {
      for (std::size_t j = 0; j < room; ++j) next[j] = u_at(j, level);
      chains::local_part({}, next.data(), next.data(), rest.data(), y.data(), 0, room,
                         {what, 0, u.data(), D.data(), D.data(), measured.to, factor});
      EXPECT_EQ(u[5], next[5]);
    }
    expect_sums(
        measured.sums,
        [&](std::size_t j) {
          double sum = 0;
          for (int level = 1; level < 4; ++level) {
            const double moved = D_at(j, level), B = moved - D_at(j, level - 1);
            sum += squares ? moved * moved + B * B / 12 : cubes ? std::pow(std::fabs(moved), 3) : std::fabs(moved);
          }
          return factor * sum;
        },
        1e-12);
  }
}

/// A level is bounded if each |z| is below 2^51, up to which a double has a fractional part of z.
TEST(ChainKernels, RejectLevelsOutsideTheRangeOfTheForce) {
  std::vector<double> z(11, 1.5);
  for (const double sign : {1.0, -1.0}) {
    z[9] = sign * std::nextafter(0x1p51, 0);
    EXPECT_TRUE(chains::bounded(z.data(), z.size()));
    for (const double beyond : {0x1p51, HUGE_VAL, std::nan("")}) {
      z[9] = sign * beyond;
      EXPECT_FALSE(chains::bounded(z.data(), z.size())) << beyond;
    }
  }
}

TEST(ChainKernels, EnergyOfAContactThatChanges) {
  const double two_pi = 2 * std::acos(-1.0);
  const chains::PeriodicForce sine = chains::substrate_force(0);
  const std::vector<double> D{0.3, -0.2}, a2{0.5, 0.3}, a2_next{0.6, 0.2}, u{0.37, -2.2};
  double energy[2];
  chains::energies_of_contacts(sine, a2.data(), a2_next.data(), u.data(), D.data(), energy, 2);
  for (std::size_t j = 0; j < 2; ++j) {
    const double cosines = std::cos(two_pi * u[j]) + std::cos(two_pi * (u[j] - D[j]));
    EXPECT_NEAR(energy[j], (a2_next[j] - a2[j]) * (1 - cosines / 2), 1e-10);
  }
}

/// The polynomial in a^2 has the least error over the range of a^2 if its error is as large at 0 as in the middle.
TEST(ChainKernels, ContactForceIsAsExactAtTheEndsAsBetween) {
  constexpr double eps = 0.03, most = 1.5;
  const chains::ContactForce force = chains::contact_force(eps, most);
  const auto error = [&](double a2) {
    const chains::PeriodicForce exact = chains::substrate_force(eps * a2);
    double largest = 0;
    for (int k = 0; k < chains::PeriodicForce::terms; ++k)
      largest = std::fmax(largest, std::fabs(force.coefficient(k, a2) - exact.c[k]));
    return largest;
  };
  double between = 0;
  for (int i = 1; i < 100; ++i) between = std::fmax(between, error(most * i / 100));
  EXPECT_GT(between, 1e-12);
  EXPECT_LT(between, 1e-3);
  EXPECT_LT(error(0), 3 * between);
  EXPECT_LT(error(most), 3 * between);
}

TEST(ChainKernels, PartsHaveTheirMiddles) {
  chains::Problem problem;
  problem.grid = {.left = -3, .spacing = 0.1, .sites = 61};
  const std::vector<double> middles = chains::middles_of_parts(problem, 1);
  ASSERT_EQ(middles.size(), 1u);
  EXPECT_NEAR(middles[0], 0, 1e-14);
}

/// A step is linear in u, S and F at its five points. Its result solves the equation in scheme.hpp for any such
/// numbers, or that of the lattice.
TEST(ChainScheme, StepSolvesTheEquation) {
  struct Value {
    double next, before, now, left, right;
    double bend() const { return left - 2 * now + right; }
  };
  const Value u{0, 0.3, -0.7, 0.2, 1.1}, S{0.4, -0.9, 0.25, 0.6, -0.35}, F{0.8, 0.5, -0.2, -0.6, 0.15};
  for (const chains::Model model : {chains::Model::sine_gordon, chains::Model::lattice})
    for (const double C : {0.0, 0.6, 5.0}) {
      chains::Problem p;
      p.grid = {0, 0.4, 40};
      p.model = model;
      p.friction = slipfront::friction::viscous(C);
      const chains::Scheme scheme = chains::scheme_of(p);
      const bool lattice = model == chains::Model::lattice;
      const double g = C * scheme.dt / 2, dt2 = scheme.dt * scheme.dt, lambda2 = dt2 / (0.4 * 0.4);
      const double theta = lattice ? 0 : (std::cosh(g) - 1) / (std::cosh(g) + 5);
      const auto shared = [&](const Value& f) {
        return lattice ? f.now : (std::exp(g) * f.next + std::exp(-g) * f.before + 10 * f.now + f.bend()) / 12;
      };
      const double of_now = (lattice ? 2 * std::cosh(g) : 2 + 10 * theta) * u.now + (lambda2 + theta) * u.bend();
      const double next =
          ((of_now - dt2 * (shared(S) - shared(F))) / (1 - theta) - std::exp(-g) * u.before) / std::exp(g);
      const auto z = [&](double displacement, double force) { return displacement + scheme.eps * force; };
      const auto y = [&](double displacement, double force) {
        return z(displacement, force) - scheme.rule.coupled * force;
      };
      const double stepped = scheme.rule.keep * z(u.now, S.now) - scheme.rule.force * S.now -
                             scheme.rule.before * z(u.before, S.before) +
                             scheme.rule.spread * (y(u.left, S.left) + y(u.right, S.right)) +
                             scheme.force * (scheme.share_next * F.next + scheme.share_before * F.before +
                                             scheme.share_now * F.now + scheme.share_neighbour * (F.left + F.right));
      EXPECT_NEAR(stepped, z(next, S.next), 1e-14) << lattice << " " << C;
    }
}

}  // namespace
