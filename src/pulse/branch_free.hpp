#pragma once

#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>

#include "elliptic_fit.hpp"

/// Elementary functions without branches or calls, so that a loop over cells becomes vector code. A few ulp each, also
/// for tiny arguments.
namespace slipfront::pulse {

/// ln(1 + x) for 0 <= x < 1e300 (after fdlibm's e_log.c).
inline double log1p_branch_free(double x) {
  const double u = 1 + x;
  const double lost = (x - (u - 1)) / u;  // what the sum has rounded away; u - 1 <= x as x >= 0, and 0 for large x
  const auto bits = std::bit_cast<std::uint64_t>(u);
  // Split u = 2^e f with f in [sqrt(1/2), sqrt(2)): add what lifts sqrt(1/2) to a power of two, read the exponent, take
  // it off.
  const std::uint64_t lifted = bits + (0x3ff0000000000000u - 0x3fe6a09e667f3bcdu);
  const double e = std::bit_cast<double>((lifted >> 52) | 0x4330000000000000u) - (4503599627370496.0 + 1023.0);
  const double f = std::bit_cast<double>((lifted & 0x000fffffffffffffu) + 0x3fe6a09e667f3bcdu);
  const double g = f - 1, h = g / (2 + g), z = h * h;
  const double R = z * (6.666666666666735130e-01 +
                        z * (3.999999999940941908e-01 +
                             z * (2.857142874366239149e-01 +
                                  z * (2.222219843214978396e-01 +
                                       z * (1.818357216161805012e-01 +
                                            z * (1.531383769920937332e-01 + z * 1.479819860511658591e-01))))));
  const double half = 0.5 * g * g;
  constexpr double ln2_high = 6.93147180369123816490e-01, ln2_low = 1.90821492927058770002e-10;
  return e * ln2_high + (g - (half - (h * (half + R) + (e * ln2_low + lost))));
}

/// c_k + c_k+1 x + ...
template <std::size_t k = 0, class Real, std::size_t terms>
inline Real polynomial(const Real (&c)[terms], Real x) {
  if constexpr (k + 1 < terms)
    return c[k] + x * polynomial<k + 1>(c, x);
  else
    return c[k];
}

/// ln(a / b) / 2 for a >= b > 0 and a caller that knows a - b without cancellation, but for the division, which he may
/// share: half_log(1 / below).
struct LogRatio {
  double above, below, halvings;
  LogRatio(double a, double b, double a_less_b) {
    // The difference of two doubles' bits is their ratio's logarithm, to 9 %: rounded it is e in a / b = 2^e f,
    // f in [2/3, 3/2].
    const std::uint64_t e =
        (std::bit_cast<std::uint64_t>(a) - std::bit_cast<std::uint64_t>(b) + 0x0008000000000000u) >> 52;
    const double lifted = std::bit_cast<double>(std::bit_cast<std::uint64_t>(b) + (e << 52));
    above = e == 0 ? a_less_b : a - lifted;
    below = a + lifted;
    halvings = std::bit_cast<double>(e | 0x4330000000000000u) - 4503599627370496.0;
  }
  double half_log(double per_below) const {
    constexpr double half_ln2 = 0.34657359027997264;
    const double h = above * per_below, z = h * h;
    return halvings * half_ln2 + (h + h * (z * (polynomial(fit::atanh_tail, z) / 2)));
  }
};

/// Parts of exp(x) = power + power e.
struct ExpParts {
  double power, e;
};
inline ExpParts exp_parts(double x) {
  constexpr double magic = 6755399441055744.0;  // adding it rounds to a whole number
  const double shifted = x * 1.4426950408889634 + magic, k = shifted - magic;
  const double r = (x - k * 6.93147180369123816490e-01) - k * 1.90821492927058770002e-10;
  double p = 1.0 / 6227020800;
  p = p * r + 1.0 / 479001600;
  p = p * r + 1.0 / 39916800;
  p = p * r + 1.0 / 3628800;
  p = p * r + 1.0 / 362880;
  p = p * r + 1.0 / 40320;
  p = p * r + 1.0 / 5040;
  p = p * r + 1.0 / 720;
  p = p * r + 1.0 / 120;
  p = p * r + 1.0 / 24;
  p = p * r + 1.0 / 6;
  p = p * r + 0.5;
  const double e = r + r * r * p;
  const double power = std::bit_cast<double>((std::bit_cast<std::uint64_t>(shifted) + 1023) << 52);  // 2^k
  return {power, e};
}

/// For |x| < 700.
inline double exp_branch_free(double x) {
  const ExpParts at = exp_parts(x);
  return at.power + at.power * at.e;
}

/// exp(x) - 1 for |x| < 700.
inline double expm1_branch_free(double x) {
  const ExpParts at = exp_parts(x);
  return at.power * at.e + (at.power - 1);
}

inline double asinh_branch_free(double x) {
  const double a = std::fabs(x);
  return std::copysign(log1p_branch_free(a + a * a / (1 + std::sqrt(1 + a * a))), x);
}

/// For 0 <= x < 1.
inline double atanh_branch_free(double x) { return 0.5 * log1p_branch_free(2 * x / (1 - x)); }

/// For |x| < 350.
inline double tanh_branch_free(double x) {
  const double e = expm1_branch_free(2 * std::fabs(x));
  return std::copysign(e / (e + 2), x);
}

inline double sinh_branch_free(double x) {
  const double e = expm1_branch_free(std::fabs(x));
  return std::copysign((e + e / (e + 1)) / 2, x);
}

}  // namespace slipfront::pulse
