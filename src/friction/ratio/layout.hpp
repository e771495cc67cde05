#pragma once
/// \file
/// How the table of friction ratios is laid out: ln(W / frictionless W(0)) as Chebyshev polynomials in
/// y = Sigma- / (1 + Sigma-) over the whole range (which needs fewer of them than ln Sigma-) and in u = ln(1 + Gamma)
/// piece by piece. Pieces share their end nodes, so the table is continuous, and Gamma = 0 is a node.
/// Layout of the tables of observed fronts and of stress drops. A table stores a function g as Chebyshev polynomials in
/// y = Sigma- / (1 + Sigma-) and in u = ln(1 + Gamma) piece by piece. For the ratio r of fronts they are also in the
/// logarithm of the threshold, with g = ln(blunt - ln r). `blunt` rounds the transition from r = 1 to a front that
/// falls behind, which is sharp in ln(-ln r) at low thresholds and in r at high ones. For stress drops
/// g = ln(drop / Sigma-).
/// The tables of coefficients, which tools/friction_ratio writes as the files *.csv of this folder.

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>

namespace slipfront::friction_ratio::layout {

inline constexpr std::size_t closures = 2, measures = 4;

inline constexpr double least_stress = 0.05, most_stress = 3, most_damping = 1e8;

/// Ends of the pieces, in Gamma. Between `unstable_from` and `uncertain_to` the closure "paper" is not certified: it is
/// unstable, and the more cells the farther up (from 400 cells on at Gamma = 3e4).
inline constexpr double uncertain_to = 1e5;
inline constexpr double unstable_from = 3, unstable_to = 1e4;
inline constexpr std::array<double, 8> ends{0, 1, unstable_from, 15, 100, 1000, unstable_to, most_damping};
inline constexpr std::size_t pieces = ends.size() - 1;

inline constexpr std::size_t u_nodes = 9, y_nodes = 15, corner_terms = 9;
using Piece = std::array<std::array<double, u_nodes>, y_nodes>;  ///< coefficient of T_i(y) T_j(u)
using Table = std::array<std::array<std::array<Piece, pieces>, measures>, closures>;

/// n numbers as functions of a variable, with their slopes.
template <std::size_t n>
struct Values {
  std::array<double, n> value, slope;
};

/// T_0 ... T_(n-1) at t.
template <std::size_t n>
Values<n> chebyshev(double t) {
  Values<n> T;
  T.value[0] = 1, T.value[1] = t;
  T.slope[0] = 0, T.slope[1] = 1;
  for (std::size_t i = 2; i < n; ++i) {
    T.value[i] = 2 * t * T.value[i - 1] - T.value[i - 2];
    T.slope[i] = 2 * T.value[i - 1] + 2 * t * T.slope[i - 1] - T.slope[i - 2];
  }
  return T;
}

/// Only the values of these polynomials.
template <std::size_t n>
std::array<double, n> chebyshev_values(double t) {
  std::array<double, n> T;
  T[0] = 1, T[1] = t;
  for (std::size_t i = 2; i < n; ++i) T[i] = 2 * t * T[i - 1] - T[i - 2];
  return T;
}

/// A range, and where one of its points lies between -1 and 1.
struct Range {
  double low, high;
  double at(double t) const { return low + (high - low) * (1 + t) / 2; }
  double to_unit(double x) const { return (2 * x - low - high) / (high - low); }
  double unit_slope() const { return 2 / (high - low); }
};
inline double y_of(double stress) { return stress / (1 + stress); }
inline double y_slope(double stress) { return 1 / ((1 + stress) * (1 + stress)); }
inline double stress_of(double y) { return y / (1 - y); }
inline Range of_stress() { return {y_of(least_stress), y_of(most_stress)}; }

/// Closure "consistent": W(0) and the peak have a corner in Gamma where the wave that left the leading edge at t = 0
/// passes them, at a ln(1 + Gamma) that is a polynomial of y, and the first two pieces meet there. All 0: no corner.
using Corner = std::array<double, corner_terms>;  ///< coefficient of T_i(y)
using Corners = std::array<std::array<Corner, measures>, closures>;
inline bool exists(const Corner& corner) { return corner[0] != 0; }

/// Ends of the pieces in u, and d/dy, at t = y between -1 and 1.
inline Values<pieces + 1> ends_at(const Corner& corner, double t) {
  static const Values<pieces + 1> fixed = [] {
    Values<pieces + 1> v{};
    for (std::size_t i = 0; i <= pieces; ++i) v.value[i] = std::log1p(ends[i]);
    return v;
  }();
  if (!exists(corner)) return fixed;
  Values<pieces + 1> u = fixed;
  const Values<corner_terms> T = chebyshev<corner_terms>(t);
  u.value[1] = 0;
  for (std::size_t i = 0; i < corner_terms; ++i) {
    u.value[1] += corner[i] * T.value[i];
    u.slope[1] += corner[i] * T.slope[i] * of_stress().unit_slope();
  }
  u.value[2] = (u.value[1] + u.value[3]) / 2;
  u.slope[2] = u.slope[1] / 2;
  return u;
}

/// Behind the corner W falls like a root of the distance to it: there the polynomials are in the root of what
/// elsewhere is x, the share of the piece that lies below u.
inline bool by_root(const Corner& corner, std::size_t piece) { return exists(corner) && piece == 1; }
inline double x_at(double t, bool root) { return root ? (1 + t) * (1 + t) / 4 : (1 + t) / 2; }
/// t between -1 and 1, and dt/dx, finite at the corner too.
inline Values<1> t_of(double x, bool root) {
  const double r = root ? std::sqrt(x) : x;
  return {{2 * r - 1}, {root ? 1 / std::fmax(r, 1e-6) : 2}};
}

}  // namespace slipfront::friction_ratio::layout

namespace slipfront::friction_ratio::front_layout {

inline constexpr std::size_t closures = 2, drops = 2;

inline constexpr double least_threshold = 1e-4, most_threshold = 0.3;

/// Ends of the pieces, in Gamma. They include the limits of the range where the closure "paper" is unstable.
inline constexpr std::array<double, 8> ends{0,  1,  layout::unstable_from, 8,
                                            20, 80, layout::unstable_to,   layout::most_damping};
inline constexpr std::size_t pieces = ends.size() - 1;

inline constexpr std::size_t u_nodes = 9, front_y_nodes = 9, drop_y_nodes = 15, threshold_nodes = 13;

inline constexpr double blunt = 0.3;
inline double from_ratio(double r) { return std::log(blunt - std::log(r)); }

/// Coefficients are multiples of this number.
inline constexpr double unit = 1e-6;
using Integer = std::int32_t;

/// Coefficients of T_i(y) T_j(u).
template <std::size_t y_nodes>
using Pieces = std::array<std::array<std::array<Integer, u_nodes>, y_nodes>, pieces>;
/// By closure, then the degree in the threshold.
using FrontTable = std::array<std::array<Pieces<front_y_nodes>, threshold_nodes>, closures>;
using DropTable = std::array<std::array<Pieces<drop_y_nodes>, drops>, closures>;

inline layout::Range of_threshold() { return {std::log(least_threshold), std::log(most_threshold)}; }

}  // namespace slipfront::friction_ratio::front_layout

namespace slipfront::friction_ratio {

extern const layout::Table coefficients;
extern const layout::Corners corners;
extern const front_layout::FrontTable front_coefficients;
extern const front_layout::DropTable drop_coefficients;

}  // namespace slipfront::friction_ratio
