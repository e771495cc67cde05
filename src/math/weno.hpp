#pragma once

#include <bit>
#include <cmath>
#include <cstdint>

namespace slipfront {

/// The limited difference across a cell from those to its neighbours: monotonized central (van Leer 1977).
inline double limited(double before, double after) {
  if (before * after <= 0) return 0;
  return std::copysign(std::fmin(std::fabs(before + after) / 2, 2 * std::fmin(std::fabs(before), std::fabs(after))),
                       before);
}

/// Value at the right face of the middle cell from five cell averages, the face nearest to d and e: fifth order where
/// smooth, no new extrema at jumps (WENO-Z: Jiang & Shu 1996; Borges et al. 2008). Pass the averages backwards for the
/// left face. Scale invariant: `tiny` only keeps a constant block from dividing by zero. The value is above / below:
/// the caller divides, and may divide for two faces at once.
struct Weno5 {
  double above, below;
  Weno5(double a, double b, double c, double d, double e) {
    const auto square = [](double x) { return x * x; };
    const double tiny = 1e-30 * (a * a + b * b + c * c + d * d + e * e) + 1e-300;
    double ia = 13.0 / 12 * square(a - 2 * b + c) + 0.25 * square(a - 4 * b + 3 * c) + tiny;
    double ib = 13.0 / 12 * square(b - 2 * c + d) + 0.25 * square(b - d) + tiny;
    double ic = 13.0 / 12 * square(c - 2 * d + e) + 0.25 * square(3 * c - 4 * d + e) + tiny;
    // Times a power of two that brings the largest near 1: none is then below 1e-32, and the weights
    // 1 + (tau / i)^2, times all three i^2, stay within the range of a double.
    constexpr std::uint64_t exponent = 0x7ff0000000000000u;
    const double unit =
        std::bit_cast<double>(0x7fe0000000000000u - (std::bit_cast<std::uint64_t>(ia + ib + ic) & exponent));
    ia *= unit;
    ib *= unit;
    ic *= unit;
    const double tau = square(ia - ic), bc = ib * ic, ac = ia * ic, ab = ia * ib;
    const double wa = (ia * ia + tau) * (bc * bc), wb = 6 * (ib * ib + tau) * (ac * ac),
                 wc = 3 * (ic * ic + tau) * (ab * ab);
    above = wa * (2 * a - 7 * b + 11 * c) + wb * (-b + 5 * c + 2 * d) + wc * (2 * c + 5 * d - e);
    below = 6 * (wa + wb + wc);
  }
};

inline double weno5(double a, double b, double c, double d, double e) {
  const Weno5 at(a, b, c, d, e);
  return at.above / at.below;
}

}  // namespace slipfront
