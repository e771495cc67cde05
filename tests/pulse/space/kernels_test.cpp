#include "averages/pulse/space/kernels.hpp"

#include <gtest/gtest.h>

#include <boost/math/special_functions/ellint_2.hpp>
#include <cmath>
#include <numbers>
#include <vector>

namespace {

using namespace slipfront;

/// A train at two faces whose momenta differ: e^(2 psi) grows by the difference of the rapidities, if they close in.
TEST(Kernels, StopTrainsThatRunIntoEachOther) {
  const std::vector<std::pair<double, double>> momenta = {{3, 1}, {2, -1}, {0.5, -4}, {-0.2, -3}, {0, -2}, {1, 1}};
  for (const auto& [left, right] : momenta) {
    const double spacing = 1.3, phi = 0.4, psi = 0.7, EK = 2.1, contact = 1.2;
    const double on_one[] = {left, right};
    double mass = 0, pressure = 0;
    pulse::masses_and_pressures({.size = 1,
                                 .spacing = &spacing,
                                 .phi = &phi,
                                 .psi = &psi,
                                 .EK = &EK,
                                 .contact = &contact,
                                 .on_one = on_one,
                                 .mass = &mass,
                                 .pressure = &pressure});
    EXPECT_NEAR(mass, 2 * EK / (spacing * std::cosh(phi)), 1e-14 * mass);
    const double closing = std::asinh(left / (8 * contact * mass)) - std::asinh(right / (8 * contact * mass));
    const double sinh = std::sinh(psi + std::fmax(closing, 0.0) / 2);
    EXPECT_NEAR(pressure, 2 * sinh * sinh, 1e-13 * pressure) << left << " " << right;
    // Their mirror images run into each other in the same way. If we exchange them, they move apart.
    const double mirrored[] = {-right, -left}, apart[] = {right, left};
    double other = 0;
    pulse::masses_and_pressures({1, &spacing, &phi, &psi, &EK, &contact, mirrored, &mass, &other});
    EXPECT_NEAR(other, pressure, 1e-14 * pressure);
    pulse::masses_and_pressures({1, &spacing, &phi, &psi, &EK, &contact, apart, &mass, &other});
    EXPECT_NEAR(other, 2 * std::sinh(psi) * std::sinh(psi), 1e-14 * other);
  }
}

/// The largest slip velocity is 2 a sinh |phi| cosh psi, and M = 8 a sinh |phi| cosh(psi) E.
TEST(Kernels, FindTrainsAtFaces) {
  for (const double psi : {1e-6, 0.01, 0.3, 1.0, 1.4})
    for (const double sinh : {1e-4, -0.3, 5.0}) {
      const double contact = 1.7;
      double fastest = 0, s = 0, per_momentum = 0;
      pulse::find_trains({1, &sinh, &psi, &contact, &fastest, &s, &per_momentum}, 0);
      const double slip = contact * std::fabs(sinh) * std::cosh(psi), tanh = std::tanh(psi);
      EXPECT_NEAR(fastest, 2 * slip, 1e-14 * slip);
      EXPECT_NEAR(s, tanh, 1e-15);
      const double M = 8 * slip * boost::math::ellint_2(std::sqrt((1 - tanh) * (1 + tanh)));
      EXPECT_NEAR(per_momentum * M / (2 * std::numbers::pi), 1, 1e-9);
    }
}

/// A creeping train counts as one with the hypotenuse of both velocities.
TEST(Kernels, AddCreepAtRightAngles) {
  const double psi = 0.6, contact = 1.3;
  for (const double creep : {1e-3, 0.4, 2.0}) {
    const double both[] = {0.4, std::hypot(0.4, creep)}, psis[] = {psi, psi}, contacts[] = {contact, contact};
    double fastest[2], s[2], per_momentum[2];
    pulse::find_trains({1, both, psis, contacts, fastest, s, per_momentum}, creep);
    pulse::find_trains({1, both + 1, psis, contacts, fastest + 1, s, per_momentum + 1}, 0);
    EXPECT_NEAR(fastest[0] / fastest[1], 1, 1e-14) << creep;
    EXPECT_NEAR(per_momentum[0] / per_momentum[1], 1, 1e-14) << creep;
  }
}

/// Waves run at +-c0 in the frame of the dislocations. The sum of velocities is that of special relativity.
TEST(Kernels, FindTheTimeInWhichAWaveCrossesACell) {
  for (const double U : {0.0, 0.3, -0.8})
    for (const double c0 : {0.1, 0.9}) {
      const auto seen = [&](double wave) { return std::fabs((U + wave) / (1 + U * wave) - U); };
      const double width = 0.7, slow = -1e-6, fast = -20;
      const double crossing = width / std::fmax(seen(c0), seen(-c0));
      EXPECT_NEAR(pulse::least_crossing_time(1, &width, &slow, &U, &c0) / crossing, 1, 1e-13);
      EXPECT_NEAR(pulse::least_crossing_time(1, &width, &fast, &U, &c0), 0.3 * width / 20, 1e-15);
    }
}

TEST(Kernels, FindTheFastestSlipOfATrain) {
  for (const double phi : {1e-9, -0.4, 3.0, -40.0})
    for (const double psi : {1e-8, 0.7, 30.0}) {
      double fastest = 0;
      pulse::fastest_slip(1, &phi, &psi, &fastest);
      EXPECT_NEAR(fastest / (2 * std::sinh(std::fabs(phi)) * std::cosh(psi)), 1, 1e-14) << phi << " " << psi;
    }
}

/// After a Newton step in M, values follow to first order. It is the last step if the equation holds before it.
TEST(Kernels, FollowValuesThroughANewtonStep) {
  const double U = 0.4, s = 0.6, fastest = 0.9, force = 0.3, slope = 0.2, weight = 2.5, momentum = 1.7;
  for (const double step : {1e-9, 0.05})
    for (const double excess : {0.0, 1e-3, -1e-3}) {
      const double free = momentum + weight * force - excess, next = momentum * (1 + step);
      double velocity = 0, typical = 0, new_force = 0, last = -1, mutable_next = next;
      pulse::find_after_newton({1, &momentum, &free, &force, &slope, &mutable_next}, weight, 1e-6, 1e-9,
                               {&s, &U, &fastest, &velocity, &typical, &new_force, &last});
      EXPECT_EQ(last, step < 1e-6 || excess == 0 ? 1 : 0);
      // U = tanh phi changes by (1 - U^2) U d ln(sinh phi), up to second order.
      EXPECT_NEAR(velocity, U + U * (1 - U * U) * step, 1e-15);
      // a sinh |phi| e^psi, where 2 a sinh |phi| cosh psi is the fastest slip and e^psi = cosh psi (1 + tanh psi).
      EXPECT_NEAR(typical, fastest / 2 * (1 + s) * (1 + step), 1e-15);
      EXPECT_NEAR(new_force, force + slope * step, 1e-15);
    }
}

/// Newton steps of both kinds lead to the root of M + weight f(M) = free.
TEST(Kernels, NewtonStepsFindTheMomentumAfterFriction) {
  for (const double power : {0.2, 0.5, 1.0, 2.0})
    for (const double weight : {1e-3, 0.3, 20.0}) {
      const double free = 2;
      double M = free;
      for (int i = 0; i < 40; ++i) {
        const double force = std::pow(M, power), slope = power * force;
        double next = 0;
        pulse::take_newton_steps({1, &M, &free, &force, &slope, &next}, weight, 1e-12);
        M = next;
      }
      EXPECT_NEAR(M + weight * std::pow(M, power), free, 1e-13) << power << " " << weight;
    }
}

/// The middle of a cell is exact if x is a cubic function of the number of dislocations next to the end of a block, and
/// one of fifth degree inside.
TEST(Kernels, MiddlesOfCellsFollowPolynomials) {
  const auto x = [](double s) { return s + 2e-3 * s * s - 1e-4 * s * s * s; };
  const auto fifth = [&](double s) { return x(s) + 3e-7 * s * s * s * s * s; };
  constexpr std::size_t n = 9;
  for (const bool cubic : {true, false}) {
    std::vector<double> faces, centres(n);
    for (std::size_t i = 0; i <= n; ++i) faces.push_back(cubic ? x(double(i)) : fifth(double(i)));
    pulse::middles({{0, n, pulse::Edge::wall, pulse::Edge::wall}}, faces, centres);
    for (std::size_t i = cubic ? 1 : 2; i + (cubic ? 1 : 2) < n; ++i)
      EXPECT_NEAR(centres[i], cubic ? x(double(i) + 0.5) : fifth(double(i) + 0.5), 1e-14) << i;
    EXPECT_EQ(centres[0], (faces[0] + faces[1]) / 2);
  }
}

}  // namespace
