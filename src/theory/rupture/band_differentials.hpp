#pragma once
/// \file
/// The two differentials of N filled bands (docs/theory/9_trains.md 9.2), in the frame of the middle of all bands. With
/// lambda = exp(2 r), lower edges E_n and upper edges U_n of the bands, they are
///
///     dp = f_p G d(lambda) / (2 sqrt(lambda)),    G = sqrt(prod_n |(lambda - E_n) / (lambda - U_n)|)
///     f_p = (1 - kappa / lambda) / 2 + sum_n alpha_n / (lambda - E_n),    kappa = sqrt(prod_n U_n / E_n)
///     f_w = (1 + kappa / lambda) / 2 + sum_n beta_n / (lambda - E_n)      for dw
///
/// These have the poles at r = +-infinity that the theory asks for. The N coefficients alpha follow from N conditions:
/// the integral over each inner gap vanishes, and so does the regularised one over the lowest gap. In this form every
/// sum keeps its digits where bands or gaps are narrow: the distances between lambdas are never differences of lambdas.
/// If the bands are wide, kappa / lambda is replaced by -kappa E_1 / (lambda (lambda - E_1)), which changes only the
/// meaning of alpha_1 and beta_1, and saves the digits that kappa and alpha_1 would cancel. Above a wide gap, 1 is
/// replaced by lambda / (lambda - E_n) for the same reason.
/// A quadrature rule for an interval between two branch points of a hyperelliptic integrand, where other branch points
/// may be as near as they like. An elliptic substitution with the two ends and their two neighbours turns the integrand
/// into an even periodic function of u. It is analytic for |Im u| < K', so the midpoint rule on 0 < u < K converges
/// like exp(-2 pi n K' / K). A neighbour at a relative distance of 1e-9 needs about 90 points.

#include <cstddef>
#include <span>
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

/// Integrals over one band, with the sign that makes that of dp positive.
struct BandIntegrals {
  double dp, dw, cosh_dp, sinh_dp, sinh_dw;
};

/// The finite parts of the integrals of p dr and w dr over one gap.
struct GapIntegral {
  double p, w;
};

/// The finite parts of the integrals of p dr and w dr over each gap, from the lowest gap up.
struct GapIntegrals {
  std::vector<double> p, w;
};

/// dp = p |r - r_j|^(-1/2) dr next to edge j, and likewise dw.
struct EdgeStrength {
  double p, w;
};

class BandDifferentials {
 public:
  /// \param widths band, gap, ... band, each positive
  explicit BandDifferentials(std::span<const double> widths);

  /// dw / dp at edge j, from the lowest one up.
  double speed(std::size_t j) const { return f_w_[j] / f_p_[j]; }
  /// dw / dp inside a band, at this rapidity above its lower edge.
  double speed_inside(std::size_t band, double from_low) const;
  BandIntegrals over_band(std::size_t band) const;
  GapIntegrals over_gaps() const;
  EdgeStrength strength(std::size_t j) const;
  /// [j][i]: the differential at edge j, like EdgeStrength, that gives the derivatives of k_i.
  std::vector<std::vector<double>> normal_differentials() const;

 private:
  /// A point of the lambda axis. It is between edges - 1 and edges of all edges, counted from 0; `below` and `above`
  /// are its distances from these two.
  struct Point {
    double lambda;
    std::size_t edges;
    double below, above;
  };
  double distance(const Point& at, std::size_t edge) const;
  double gap_weight(const Point& at) const;  ///< G
  struct Values {
    double p, w;
  };
  Values values(const Point& at) const;  ///< f_p and f_w
  Point point(const RulePoint& at, std::size_t edges) const;
  std::vector<RulePoint> rule(std::size_t low_edge) const;
  double apart(std::size_t i, std::size_t j) const { return apart_[i * edges_ + j]; }
  double pole_at_0(const Point& at) const;
  double pole_at_infinity(const Point& at) const;
  double loss_at_lowest_edge(const Point& at, double G, double sn2, double cn2) const;
  void solve(double sum_of_bands);
  void add_lowest_gap(double sum_of_bands);
  void add_inner_gaps();
  GapIntegral over_lowest_gap() const;
  GapIntegral over_inner_gap(std::size_t m) const;
  GapIntegral over_highest_gap() const;
  void take_upper_edges();

  std::size_t trains_, edges_;
  double total_ = 0;  ///< from the lowest to the highest edge
  double kappa_;
  bool wide_;
  std::size_t screen_ = 0;      ///< the highest band with a wide gap below it; 0: none
  std::vector<double> offset_;  ///< r_j minus the middle
  std::vector<double> lambda_;  ///< exp(2 offset)
  std::vector<double> apart_;   ///< |lambda_i - lambda_j|
  std::vector<double> matrix_;  ///< the conditions on the gaps, one a row
  std::vector<double> alpha_, beta_;
  std::vector<double> f_p_, f_w_;  ///< at upper edges; at a lower edge alpha and beta, as f is infinite there
};

}  // namespace slipfront::rupture
