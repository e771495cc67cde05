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

#include <cstddef>
#include <span>
#include <vector>

#include "theory/rupture/interval_rule.hpp"

namespace slipfront::rupture {

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
