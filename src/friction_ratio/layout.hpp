#pragma once
/// \file
/// How the table of friction ratios is laid out: ln(W / frictionless W(0)) as Chebyshev polynomials in
/// y = Sigma- / (1 + Sigma-) over the whole range (which needs fewer of them than ln Sigma-) and in u = ln(1 + Gamma)
/// piece by piece. Pieces share their end nodes, so the table is continuous, and Gamma = 0 is a node.

#include <array>
#include <cmath>
#include <cstddef>

namespace slipfront::friction_ratio::layout {

inline constexpr std::size_t closures = 2, measures = 3;

inline constexpr double least_stress = 0.05, most_stress = 3, most_damping = 1e8;

/// Ends of the pieces, in Gamma. Between `unstable_from` and `unstable_to` the closure "paper" is not certified.
inline constexpr double unstable_from = 3, unstable_to = 1e4;
/// Closure "consistent": W(0) and the peak have a corner here that the polynomials round off.
inline constexpr double corner_from = 0.5, corner_to = 10;
inline constexpr std::array<double, 8> ends{0, 1, unstable_from, 15, 100, 1000, unstable_to, most_damping};
inline constexpr std::size_t pieces = ends.size() - 1;

inline constexpr std::size_t u_nodes = 9, y_nodes = 15;
using Piece = std::array<std::array<double, u_nodes>, y_nodes>;  ///< coefficient of T_i(y) T_j(u)
using Table = std::array<std::array<std::array<Piece, pieces>, measures>, closures>;

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
inline Range of_piece(std::size_t piece) { return {std::log1p(ends[piece]), std::log1p(ends[piece + 1])}; }

}  // namespace slipfront::friction_ratio::layout
