#pragma once
/// \file
/// Layout of the tables of observed fronts and of stress drops. A table stores a function g as Chebyshev polynomials in
/// y = Sigma- / (1 + Sigma-) and in u = ln(1 + Gamma) piece by piece. For the ratio r of fronts they are also in the
/// logarithm of the threshold, with g = ln(blunt - ln r). `blunt` rounds the transition from r = 1 to a front that
/// falls behind, which is sharp in ln(-ln r) at low thresholds and in r at high ones. For stress drops
/// g = ln(drop / Sigma-).

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>

#include "friction_ratio/layout.hpp"

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
