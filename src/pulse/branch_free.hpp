#pragma once

#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>

#include "elliptic_fit.hpp"

/// Elementary functions without branches or calls, so that a loop over cells becomes vector code. A few ulp each, also
/// for tiny arguments.
namespace slipfront::pulse {

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
  constexpr double c[] = {1.0 / 2,     1.0 / 6,      1.0 / 24,      1.0 / 120,      1.0 / 720,       1.0 / 5040,
                          1.0 / 40320, 1.0 / 362880, 1.0 / 3628800, 1.0 / 39916800, 1.0 / 479001600, 1.0 / 6227020800};
  const double e = r + r * r * polynomial(c, r);
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

}  // namespace slipfront::pulse
