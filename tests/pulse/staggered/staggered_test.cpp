// The staggered equations: momenta at the faces, and the step that takes friction there implicitly.

#include "averages/pulse/staggered/staggered.hpp"

#include <gtest/gtest.h>

#include <boost/math/special_functions/ellint_2.hpp>
#include <cmath>
#include <vector>

#include "slipfront/theory/modulation/modulation.hpp"
#include "slipfront/theory/train.hpp"

namespace {

using namespace slipfront;
using pulse::Edge;
using pulse::Staggered;

constexpr std::size_t cells = 12;

pulse::Setup setup(const friction::Friction& friction, Edge edge = Edge::wall) {
  pulse::Setup s;
  s.charge.assign(cells, 0.05);
  s.left = s.right = edge;
  s.left_wall = 0;
  s.right_wall = cells * 0.4;
  s.friction = friction;
  return s;
}

/// Unknowns of cells of equal width with a momentum at each face but the outer ones.
std::vector<double> unknowns(double width, double momentum) {
  std::vector<double> z(pulse::FaceValues::size(cells + 1), 0.0);
  const pulse::FaceValues values(z.data(), cells + 1);
  for (std::size_t i = 0; i < cells; ++i) values.width(i) = width;
  for (std::size_t f = 1; f < cells; ++f) values.momentum(f) = momentum;
  return z;
}

std::vector<double> rates_of(Staggered& equations, const std::vector<double>& z) {
  std::vector<double> rates(z.size());
  equations.start_from(std::vector<double>(cells, 0.3));
  equations(0, z.data(), rates.data());
  return rates;
}

TEST(Staggered, CarriesALineOfMomentaToTheFacesAndBack) {
  const Staggered equations(setup(friction::viscous(1), Edge::continued));
  std::vector<double> in_cells(cells), at_faces(cells + 1), back(cells);
  for (std::size_t i = 0; i < cells; ++i) in_cells[i] = 1 + 0.1 * static_cast<double>(i);
  equations.face_momenta(in_cells.data(), at_faces.data());
  equations.cell_momenta(at_faces.data(), back.data());
  for (std::size_t i = 2; i + 2 < cells; ++i) EXPECT_NEAR(back[i], in_cells[i], 1e-14) << i;
}

TEST(Staggered, LeavesATrainAtRestAtRest) {
  Staggered equations(setup(friction::viscous(1)));
  const std::vector<double> z = unknowns(0.4, 0);
  const std::vector<double> rates = rates_of(equations, z);
  for (const double rate : rates) EXPECT_EQ(rate, 0);
}

TEST(Staggered, DampsEveryMomentumAtTheRateOfViscousFriction) {
  Staggered equations(setup(friction::viscous(2)));
  const std::vector<double> z = unknowns(0.4, 1e-4);
  const std::vector<double> rates = rates_of(equations, z);
  const pulse::ConstFaceValues rate(rates.data(), cells + 1);
  for (std::size_t f = 2; f + 1 < cells; ++f) EXPECT_NEAR(rate.momentum(f), -2e-4, 1e-8) << f;
}

TEST(Staggered, StepsTakeTheFrictionOfTheirEnd) {
  for (const double time : {0.1, 1.0, 30.0}) {
    Staggered equations(setup(friction::viscous(2)));
    const std::vector<double> z = unknowns(0.4, 1e-8);
    std::vector<double> next(z.size());
    equations.start_from(std::vector<double>(cells, 0.3));
    equations.split_step(0, time, z.data(), next.data());
    const pulse::ConstFaceValues then(next.data(), cells + 1);
    for (std::size_t f = 3; f + 2 < cells; ++f)
      EXPECT_NEAR(then.momentum(f), 1e-8 / (1 + 2 * time), 1e-12 / (1 + 2 * time)) << time;
  }
}

/// Lengths over a, momenta over a and forces over a^2 are those of a train with contact ratio 1. Here two trains run
/// into each other, whose pressure stops them.
TEST(Staggered, ScalesForcesWithTheSquareOfAUniformContactRatio) {
  constexpr double a = 1.7, momentum = 1e-4;
  pulse::Setup scaled = setup(friction::viscous(1e-3)), plain = scaled;
  scaled.contact = [](double) { return a; };
  scaled.charge.assign(cells, 0.2);
  plain.charge.assign(cells, 0.2 / a);
  std::vector<double> z = unknowns(0.4, 0);
  const pulse::FaceValues values(z.data(), cells + 1);
  for (std::size_t f = 1; f < cells; ++f) values.momentum(f) = f <= cells / 2 ? momentum : -momentum;
  Staggered with_contact(scaled), without(plain);
  const std::vector<double> rates = rates_of(with_contact, z);
  for (std::size_t f = 1; f < cells; ++f) values.momentum(f) /= a * a;
  const std::vector<double> unit_rates = rates_of(without, z);
  const pulse::ConstFaceValues rate(rates.data(), cells + 1), unit_rate(unit_rates.data(), cells + 1);
  EXPECT_LT(unit_rate.momentum(cells / 2), -0.1 * momentum);
  for (std::size_t f = 1; f < cells; ++f) EXPECT_NEAR(rate.momentum(f) / (a * a * unit_rate.momentum(f)), 1, 1e-3) << f;
}

/// Means over the cells of momenta that are a cubic function inside a block, and a line in its end cells.
TEST(Staggered, FindsMeansOfCubicMomenta) {
  pulse::Setup two = setup(friction::viscous(1), Edge::free);
  two.charge[5] = 0;
  const Staggered equations(two);
  const auto f = [](double x) { return 1 + 0.3 * x - 0.02 * x * x + 1e-3 * x * x * x; };
  const auto integral = [](double x) { return x + 0.15 * x * x - 0.02 / 3 * x * x * x + 0.25e-3 * x * x * x * x; };
  std::vector<double> at_faces, means(cells);
  for (std::size_t face = 0; face <= cells; ++face) at_faces.push_back(equations.charge_around(face) * f(double(face)));
  equations.cell_momenta(at_faces.data(), means.data());
  for (std::size_t i = 0; i < cells; ++i) {
    const auto x = double(i);
    const bool at_end = i == 0 || i == 4 || i == 6 || i + 1 == cells;
    const double mean = at_end ? (f(x) + f(x + 1)) / 2 : integral(x + 1) - integral(x);
    EXPECT_NEAR(means[i], i == 5 ? 0 : 0.05 * mean, 1e-14) << i;
  }
}

/// Under viscous friction the terminal momentum is force / C, and its velocity that of a train with this momentum.
TEST(Staggered, FindsTheTerminalMotionOfTheDislocationUnderTheLargestForce) {
  for (const double C : {0.5, 20.0}) {
    Staggered equations(setup(friction::viscous(C)));
    const std::vector<double> z = unknowns(0.4, 0);
    std::vector<double> rates = rates_of(equations, z);
    const pulse::FaceValues rate(rates.data(), cells + 1);
    rate.momentum(4) = 0.002;
    rate.momentum(6) = -0.05;  // 1 on each dislocation
    rate.momentum(7) = 0.01;
    const Staggered::Terminal terminal = equations.terminal(rates.data());
    EXPECT_NEAR(terminal.momentum * C, 1, 1e-9);
    EXPECT_EQ(terminal.rate, C);
    const State at_rest = modulation::state_of({8, 0}, 0.5);
    const double mass = std::cosh(at_rest.psi) * boost::math::ellint_2(1 / std::cosh(at_rest.psi));
    EXPECT_NEAR(terminal.velocity, std::tanh(std::asinh(1 / (8 * C * mass))), 1e-9);
  }
}

TEST(Staggered, CountsTheWorkOfFriction) {
  Staggered equations(setup(friction::viscous(2)));
  const std::vector<double> z = unknowns(0.4, 1e-4);
  const std::vector<double> rates = rates_of(equations, z);
  const pulse::ConstFaceValues rate(rates.data(), cells + 1);
  const double velocity = std::tanh(modulation::state_of({8, 1e-4 / 0.05}, 0.5).phi);
  EXPECT_NEAR(rate.dissipated() / ((cells - 1) * velocity * 2 * 1e-4), 1, 1e-6);
}

}  // namespace
