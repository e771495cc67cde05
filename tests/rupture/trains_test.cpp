#include "slipfront/theory/rupture/trains.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cfloat>
#include <cmath>
#include <numeric>
#include <random>
#include <sstream>
#include <string>
#include <vector>

#include "reference_table.hpp"
#include "slipfront/error.hpp"
#include "slipfront/theory/modulation/modulation.hpp"
#include "slipfront/theory/train.hpp"

namespace {

using namespace slipfront;
using rupture::BandAverages;
using rupture::FilledBands;

std::vector<double> numbers(const std::string& text) {
  std::istringstream in(text);
  std::vector<double> values;
  for (double value; in >> value;) values.push_back(value);
  return values;
}

/// One to four trains with widths from 1e-9 to 5, evenly in their logarithm.
FilledBands random_bands(std::mt19937_64& draw) {
  FilledBands bands{std::uniform_real_distribution(-2.0, 2.0)(draw), {}};
  bands.widths.resize(2 * std::uniform_int_distribution<std::size_t>(1, 4)(draw) - 1);
  std::uniform_real_distribution<double> log_width(std::log(1e-9), std::log(5.0));
  for (double& width : bands.widths) width = std::exp(log_width(draw));
  return bands;
}

double share_of(const BandAverages& a, double rupture::TrainShare::*one, double rupture::TrainShare::*two) {
  double sum = 0;
  for (const auto& train : a.trains) sum += train.*one * train.*two;
  return sum;
}

TEST(Trains, MatchTheTable) {
  for (const auto& row : reference_table("trains.csv")) {
    const FilledBands bands{row["centre"], numbers(row.text("widths"))};
    const BandAverages a = rupture::averages(bands);
    const std::string where = row.text("centre") + " | " + row.text("widths");
    constexpr double relative = 1e-13;
    const auto speeds = numbers(row.text("speeds")), k = numbers(row.text("k")), omega = numbers(row.text("omega")),
               I = numbers(row.text("I")), J = numbers(row.text("J"));
    const std::vector<double> only_speeds = rupture::edge_speeds(bands);
    for (std::size_t j = 0; j < speeds.size(); ++j) {
      EXPECT_NEAR(a.speeds[j], speeds[j], relative * std::fmax(std::fabs(speeds[j]), speeds.back() - speeds.front()))
          << where;
      EXPECT_EQ(a.speeds[j], only_speeds[j]) << where;
    }
    ASSERT_EQ(a.trains.size(), k.size());
    for (std::size_t i = 0; i < k.size(); ++i) {
      EXPECT_NEAR(a.trains[i].k, k[i], relative * k[i]) << where;
      EXPECT_NEAR(a.trains[i].omega, omega[i], relative * std::fabs(omega[i])) << where;
      const double size = std::fabs(I[i]) + std::fabs(J[i]);
      EXPECT_NEAR(a.trains[i].I, I[i], relative * size) << where;
      EXPECT_NEAR(a.trains[i].J, J[i], relative * size) << where;
    }
    EXPECT_NEAR(a.P, row["P"], relative * std::fabs(row["P"])) << where;
    EXPECT_NEAR(a.H, row["H"], relative * row["H"]) << where;
    EXPECT_NEAR(a.Q, row["Q"], relative * row["Q"]) << where;
  }
}

/// PHYSICS.md, section 14, prints this state with eight to ten digits.
TEST(Trains, ReproduceThePrintedState) {
  const std::array edges = {-0.1, 0.05, 0.2, 0.45};
  const BandAverages a = rupture::averages(rupture::bands_of_edges(edges));
  const std::array speeds = {-0.55406978, -0.079921187, 0.13584596, 0.75218808};
  for (std::size_t j = 0; j < 4; ++j) EXPECT_NEAR(a.speeds[j], speeds[j], 5e-9);
  EXPECT_NEAR(a.trains[0].k, 0.4827883171, 5e-11);
  EXPECT_NEAR(a.trains[1].k, 0.712364593, 5e-10);
  EXPECT_NEAR(a.trains[0].omega, -0.1793472103, 5e-11);
  EXPECT_NEAR(a.trains[1].omega, 0.3887314155, 5e-11);
  EXPECT_NEAR(a.P, 0.3038299337, 5e-11);
  EXPECT_NEAR(a.H, 1.58298931, 5e-9);
  EXPECT_NEAR(a.Q, 0.2077003723, 5e-11);
}

/// The second route is the closed form with K and E of Eqs. (4) to (7).
TEST(Trains, AreTheClosedFormForOneTrain) {
  for (const double psi : {1e-302, 1e-30, 1e-9, 1e-3, 0.1, 0.7, 1.5, 2.5})
    for (const double phi : {-1.0, 0.0, 0.4, 2.0}) {
      const State state{phi, psi};
      const BandAverages a = rupture::averages(rupture::bands_of_train(state));
      const train::Averages one = train::averages(state);
      const modulation::Speeds speeds = modulation::characteristic_speeds(state);
      const double relative = psi < 1e-100 ? 5e-13 : 2e-14;  // 1600 points instead of 10 to 200
      const auto expect = [&](double got, double want, double size) {
        EXPECT_NEAR(got, want, relative * size) << phi << " " << psi;
      };
      // A boost loses digits where it nearly stops a fast edge.
      expect(a.speeds[0], speeds.minus, std::fabs(speeds.minus) * std::exp(2 * psi));
      expect(a.speeds[1], speeds.plus, std::fabs(speeds.plus) * std::exp(2 * psi));
      expect(a.k, one.k, one.k);
      expect(a.W, one.W, std::fabs(one.W) + one.k * modulation::sound(psi).c0);
      const double of_actions = psi < 1e-20 ? 10 : 1;
      expect(a.trains[0].I, one.I, of_actions * one.J);
      expect(a.trains[0].J, one.J, of_actions * one.J);
      expect(a.P, one.P, std::fabs(one.P) + one.k * modulation::sound(psi).c0);
      expect(a.H, one.H, one.H);
      expect(a.Q, one.Q, one.Q + DBL_MIN);
    }
}

TEST(Trains, SatisfyTheIdentitiesOfTheAveragedLagrangian) {
  std::mt19937_64 draw(47);
  for (int n = 0; n < 10000; ++n) {
    const FilledBands bands = random_bands(draw);
    const BandAverages a = rupture::averages(bands);
    using RankSites = rupture::TrainShare;
    const double small = 1e-12 * a.H;
    ASSERT_NEAR(share_of(a, &RankSites::k, &RankSites::I), a.P, small) << n;
    ASSERT_NEAR(share_of(a, &RankSites::omega, &RankSites::I) + share_of(a, &RankSites::k, &RankSites::J), a.H + a.Q,
                small)
        << n;
    for (const auto& train : a.trains) ASSERT_GT(train.k, std::fabs(train.omega)) << n;
    for (std::size_t j = 0; j < a.speeds.size(); ++j) {
      ASSERT_LT(std::fabs(a.speeds[j]), 1) << n;
      if (j > 0) {
        ASSERT_GE(a.speeds[j], a.speeds[j - 1]) << n;
      }
    }
  }
}

TEST(Trains, FollowABoostAsVectorsAndTensors) {
  std::mt19937_64 draw(48);
  for (int n = 0; n < 1000; ++n) {
    FilledBands bands = random_bands(draw);
    const BandAverages a = rupture::averages(bands);
    const double boost = std::uniform_real_distribution(-1.0, 1.0)(draw), c = std::cosh(boost), s = std::sinh(boost);
    bands.centre += boost;
    const BandAverages b = rupture::averages(bands);
    for (std::size_t j = 0; j < a.speeds.size(); ++j)
      ASSERT_NEAR(b.speeds[j], (a.speeds[j] * c + s) / (c + a.speeds[j] * s), 1e-13);
    for (std::size_t i = 0; i < a.trains.size(); ++i) {
      const auto &one = a.trains[i], &two = b.trains[i];
      const double action = 1e-13 * (std::fabs(two.I) + std::fabs(two.J));
      ASSERT_NEAR(two.k, c * one.k + s * one.omega, 1e-13 * two.k);
      ASSERT_NEAR(two.omega, c * one.omega + s * one.k, 1e-13 * two.k);
      ASSERT_NEAR(two.I, c * one.I + s * one.J, action);
      ASSERT_NEAR(two.J, c * one.J + s * one.I, action);
    }
    ASSERT_NEAR(b.H, c * c * a.H + 2 * c * s * a.P + s * s * a.Q, 1e-13 * b.H);
    ASSERT_NEAR(b.P, (c * c + s * s) * a.P + c * s * (a.H + a.Q), 1e-13 * b.H);
    ASSERT_NEAR(b.Q, s * s * a.H + 2 * c * s * a.P + c * c * a.Q, 1e-13 * b.H);
  }
}

/// The formulas treat lower and upper edges of bands differently, so this is a test of their accuracy too.
TEST(Trains, HaveTheMirrorImageOfMirroredBands) {
  std::mt19937_64 draw(49);
  for (int n = 0; n < 1000; ++n) {
    const FilledBands bands = random_bands(draw);
    FilledBands mirror{-bands.centre, {bands.widths.rbegin(), bands.widths.rend()}};
    const BandAverages a = rupture::averages(bands), b = rupture::averages(mirror);
    const std::size_t last = a.speeds.size() - 1, top = a.trains.size() - 1;
    const double spread = std::accumulate(bands.widths.begin(), bands.widths.end(), 0.0);
    const double relative = bands.trains() < 3 || spread < 7 ? 1e-12 : 1e-11;
    for (std::size_t j = 0; j <= last; ++j) ASSERT_NEAR(a.speeds[j], -b.speeds[last - j], relative) << n;
    for (std::size_t i = 0; i <= top; ++i) {
      const auto &one = a.trains[i], &two = b.trains[top - i];
      ASSERT_NEAR(one.k, two.k, relative * one.k) << n;
      ASSERT_NEAR(one.omega, -two.omega, relative * one.k) << n;
      ASSERT_NEAR(one.I, -two.I, relative * (std::fabs(one.I) + std::fabs(one.J))) << n;
      ASSERT_NEAR(one.J, two.J, relative * (std::fabs(one.I) + std::fabs(one.J))) << n;
    }
    ASSERT_NEAR(a.P, -b.P, relative * a.H) << n;
    ASSERT_NEAR(a.H, b.H, relative * a.H) << n;
    ASSERT_NEAR(a.Q, b.Q, relative * a.H) << n;
  }
}

/// A boost shifts all edges, so the sums of the derivatives are known.
TEST(Trains, HaveDerivativesThatAddUpToABoost) {
  std::mt19937_64 draw(50);
  for (int n = 0; n < 1000; ++n) {
    const FilledBands bands = random_bands(draw);
    const BandAverages a = rupture::averages(bands);
    const rupture::BandDerivatives d = rupture::derivatives(bands);
    double H = 0, P = 0, Q = 0, H_size = 0;
    for (std::size_t j = 0; j < d.speeds.size(); ++j) {
      const double v = d.speeds[j];
      H += d.H[j];
      P += v * d.H[j];
      Q += v * v * d.H[j];
      H_size += std::fabs(d.H[j]);
    }
    ASSERT_NEAR(H, 2 * a.P, 1e-12 * H_size);
    ASSERT_NEAR(P, a.H + a.Q, 1e-12 * H_size);
    ASSERT_NEAR(Q, 2 * a.P, 1e-12 * H_size);
    for (std::size_t i = 0; i < a.trains.size(); ++i) {
      double k = 0, omega = 0, size = 0;
      for (std::size_t j = 0; j < d.speeds.size(); ++j) {
        k += d.k[j][i];
        omega += d.speeds[j] * d.k[j][i];
        size += std::fabs(d.k[j][i]);
      }
      ASSERT_NEAR(k, a.trains[i].omega, 1e-12 * size);
      ASSERT_NEAR(omega, a.trains[i].k, 1e-12 * size);
    }
  }
}

TEST(Trains, HaveTheDerivativesOfTheirAverages) {
  const std::array edges = {-0.3, -0.1, 0.05, 0.2, 0.45, 1.2};
  const rupture::BandDerivatives d = rupture::derivatives(rupture::bands_of_edges(edges));
  constexpr double h = 1e-3;
  for (std::size_t j = 0; j < edges.size(); ++j) {
    const auto at = [&](double step) {
      auto moved = edges;
      moved[j] += step;
      return rupture::averages(rupture::bands_of_edges(moved));
    };
    const std::array<BandAverages, 6> a = {at(-3 * h), at(-2 * h), at(-h), at(h), at(2 * h), at(3 * h)};
    const auto slope = [&](auto value) {
      return (45 * (value(a[3]) - value(a[2])) - 9 * (value(a[4]) - value(a[1])) + value(a[5]) - value(a[0])) /
             (60 * h);
    };
    const double v = d.speeds[j];
    EXPECT_NEAR(d.H[j], slope([](const auto& x) { return x.H; }), 1e-8);
    EXPECT_NEAR(v * d.H[j], slope([](const auto& x) { return x.P; }), 1e-8);
    EXPECT_NEAR(v * v * d.H[j], slope([](const auto& x) { return x.Q; }), 1e-8);
    for (std::size_t i = 0; i < 3; ++i) {
      EXPECT_NEAR(d.k[j][i], slope([i](const auto& x) { return x.trains[i].k; }), 1e-8);
      EXPECT_NEAR(v * d.k[j][i], slope([i](const auto& x) { return x.trains[i].omega; }), 1e-8);
      // wave action is conserved: I_t + J_x = 0
      EXPECT_NEAR(v * slope([i](const auto& x) { return x.trains[i].I; }),
                  slope([i](const auto& x) { return x.trains[i].J; }), 1e-8);
    }
  }
}

/// The limits differ from narrow bands and gaps by the width times its logarithm.
TEST(Trains, HaveSpeedsThatAreContinuousWhereABandOrGapCloses) {
  struct Case {
    std::vector<double> widths;
    std::size_t closed;
  };
  const Case cases[] = {{{0, 0.3, 0.5}, 0}, {{0.5, 0.3, 0}, 2},           {{0.2, 0.3, 0, 0.1, 0.4}, 2},
                        {{0.5, 0, 0.7}, 1}, {{0.2, 0, 0.3, 0.1, 0.4}, 1}, {{0.2, 0.1, 0.3, 0, 0.4}, 3}};
  for (const auto& [widths, closed] : cases)
    for (const double small : {1e-3, 1e-6, 1e-9, 1e-12}) {
      std::vector<double> open = widths;
      open[closed] = small;
      const auto limit = rupture::edge_speeds({0.1, widths}), near = rupture::edge_speeds({0.1, open});
      for (const std::size_t j : {closed, closed + 1})
        EXPECT_NEAR(limit[j], near[j], 5 * small * (1 - std::log(small))) << widths.size() << " " << small << " " << j;
    }
}

TEST(Trains, AreNotAffectedByABandWithoutWidth) {
  const auto all = rupture::edge_speeds({0.15, {0.2, 0.3, 0, 0.1, 0.4}}),
             without = rupture::edge_speeds({0.15, {0.2, 0.4, 0.4}});
  for (const std::size_t j : {0U, 1U}) EXPECT_NEAR(all[j], without[j], 1e-15);
  for (const std::size_t j : {4U, 5U}) EXPECT_NEAR(all[j], without[j - 2], 1e-15);
  const auto touching = rupture::edge_speeds({0.15, {0.2, 0.3, 0, 0, 0.4}}),
             one = rupture::edge_speeds({0.15, {0.2, 0.3, 0.4}});
  for (const std::size_t j : {2U, 3U, 4U}) EXPECT_EQ(touching[j], one[2]);
  const auto free = rupture::edge_speeds({0.15, {0, 0.4, 0}});
  EXPECT_NEAR(free[0], std::tanh(-0.05), 1e-15);
  EXPECT_NEAR(free[3], std::tanh(0.35), 1e-15);
}

/// Each overtaking shifts a dislocation forward.
TEST(Trains, LetADislocationRunFasterThroughATrain) {
  const auto near = rupture::edge_speeds({0.25, {0.5, 0.3, 0}});
  EXPECT_GT(near[2], std::tanh(0.25 + 0.4));
  EXPECT_EQ(near[2], near[3]);
}

TEST(Trains, RefuseWidthsWithoutAMeaning) {
  EXPECT_THROW(rupture::averages({0, {-1}}), InputError);
  EXPECT_THROW(rupture::averages({0, {}}), InputError);
  EXPECT_THROW(rupture::averages({0, {1, 1}}), InputError);
  EXPECT_THROW(rupture::averages({0, {1, 0, 1}}), InputError);
  EXPECT_THROW(rupture::averages({0, {NAN}}), InputError);
  EXPECT_THROW(rupture::averages({NAN, {1}}), InputError);
  EXPECT_THROW(rupture::averages({0, {81}}), InputError);
  EXPECT_THROW(rupture::edge_speeds({0, {1, -0.1, 1}}), InputError);
  EXPECT_THROW(rupture::edge_speeds({0, {1e-305}}), InputError);
}

/// The averages of moved edges change as the balances of dislocations, momentum and energy require.
TEST(Trains, FrictionAndLoadChangeTheEdgesAsTheBalancesRequire) {
  std::mt19937_64 draw(47);
  std::uniform_real_distribution<double> any(-1, 1), log_width(std::log(1e-3), std::log(2.0));
  for (int n = 0; n < 200; ++n) {
    FilledBands bands{any(draw), std::vector<double>(n % 2 == 0 ? 3 : 1)};
    for (double& width : bands.widths) width = std::exp(log_width(draw));
    const double load = any(draw), viscosity = std::fabs(any(draw));
    const std::vector<double> sources = rupture::edge_sources(bands, load, viscosity), edges = bands.edges();
    const auto moved = [&](double by) {
      std::vector<double> to = edges;
      for (std::size_t j = 0; j < to.size(); ++j) to[j] += by * sources[j];
      return rupture::averages(rupture::bands_of_edges(to));
    };
    const double narrowest = *std::min_element(bands.widths.begin(), bands.widths.end());
    double fastest = 0;
    for (const double r_t : sources) fastest = std::fmax(fastest, std::fabs(r_t));
    const double h = 1e-3 * narrowest / fastest;
    const BandAverages a = moved(-h), b = moved(h), now = rupture::averages(bands);
    double squared_rate = 0;
    for (const auto& train : now.trains) squared_rate += train.omega * train.I;
    const double gained_P = load * now.k - viscosity * now.P, gained_H = load * now.W - viscosity * squared_rate;
    const double tolerance = 1e-5 * (std::fabs(load) * now.k + viscosity * now.H) + 1e-13 / h;
    EXPECT_NEAR((b.P - a.P) / (2 * h), gained_P, tolerance) << n;
    EXPECT_NEAR((b.H - a.H) / (2 * h), gained_H, tolerance) << n;
    for (std::size_t i = 0; i < now.trains.size(); ++i)
      EXPECT_NEAR((b.trains[i].k - a.trains[i].k) / (2 * h), 0, tolerance) << n;
  }
}

TEST(Trains, SourcesTendToThoseOfOneTrainWhereAGapOrBandCloses) {
  const double load = 0.2, viscosity = 0.4;
  const auto sources = [&](FilledBands bands) { return rupture::edge_sources(bands, load, viscosity); };
  const std::vector<double> one = sources({0.3, {1.1}}), closed = sources({0.3, {0.5, 0, 0.6}});
  for (const double gap : {1e-3, 1e-5, 1e-8}) {
    const std::vector<double> two = sources({0.3, {0.5, gap, 0.6 - gap}});
    EXPECT_NEAR(two[0], one[0], 1e-3 * gap + 1e-8);
    EXPECT_NEAR(two[3], one[1], 1e-3 * gap + 1e-8);
    EXPECT_NEAR((two[1] + two[2]) / 2, (closed[1] + closed[2]) / 2, 0.1 * gap + 1e-8);
  }
  const std::vector<double> empty = sources({0.3, {1.1, 0.4, 0}});
  for (const double band : {1e-3, 1e-5, 1e-6}) {
    const std::vector<double> few = sources({0.3, {1.1, 0.4, band}});
    EXPECT_NEAR((few[2] + few[3]) / 2, (empty[2] + empty[3]) / 2, band + 1e-8);
  }
}

}  // namespace
