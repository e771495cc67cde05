#pragma once
/// \file
/// A quadrature rule for an interval between two branch points of a hyperelliptic integrand, where other branch points
/// may be as near as they like. An elliptic substitution with the two ends and their two neighbours turns the integrand
/// into an even periodic function of u. It is analytic for |Im u| < K', so the midpoint rule on 0 < u < K converges
/// like exp(-2 pi n K' / K). A neighbour at a relative distance of 1e-9 needs about 90 points.

#include <vector>

namespace slipfront::rupture {

/// sn^2, cn^2 and dn^2 at one point. Squares need no square roots, and none of them is a difference of near numbers.
struct EllipticSquares {
  double sn2, cn2, dn2;
};

/// The midpoints K (j + 1/2) / n, j = 0 ... n - 1.
struct MidpointGrid {
  double K;
  double log_nome;  ///< -pi K' / K
  std::vector<EllipticSquares> at;

  double step() const { return K / static_cast<double>(at.size()); }
};

/// How many points a grid has. The Fourier coefficients of an integrand need twice as many as its integral.
enum class Resolution { integral = 1, series = 2 };

/// Both m and the complementary modulus sqrt(1 - m) have to be precise, because either may be tiny.
MidpointGrid midpoint_grid(double m, double complementary_modulus, Resolution resolution = Resolution::integral);

/// One point lambda between the ends a and b, with the distances from both to full relative precision.
struct RulePoint {
  double from_a;  ///< lambda - a
  double to_b;    ///< b - lambda
  double weight;  ///< |d lambda / d u| times the step
};

/// The distances between the ends a < b of an interval and its neighbours a_out < a and b_out > b, each positive.
/// Infinity is allowed for from_a_out and to_b_out, but not for both.
struct IntervalEnds {
  double width;       ///< b - a
  double from_a_out;  ///< a - a_out
  double to_b_out;    ///< b_out - b
};

std::vector<RulePoint> interval_rule(const IntervalEnds& ends);

/// Weights W_j such that the integral of ln sn(u) F(u) over 0 < u < K is -step times the sum of W_j F(u_j), for a
/// smooth even periodic F whose integral vanishes. It follows from the Fourier series of ln sn. The grid needs
/// Resolution::series.
std::vector<double> log_sn_weights(const MidpointGrid& grid);

}  // namespace slipfront::rupture
