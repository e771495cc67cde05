#pragma once

#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>

// A compiler that weighs the size of these functions stops inlining them where many loops use them, and loops that call
// are no vector code.
#define SLIPFRONT_INLINE [[gnu::always_inline]] inline

/// Elementary functions without branches or calls, so that the compiler vectorises loops over them. Their errors are a
/// few ulp (asinh: 70 ulp), also for tiny arguments.
namespace slipfront {

SLIPFRONT_INLINE double at_least(double x, double least) { return x > least ? x : least; }
SLIPFRONT_INLINE double at_most(double x, double most) { return x < most ? x : most; }

/// Returns c_k + c_(k+1) x + ...
template <std::size_t k = 0, class Real, std::size_t terms>
SLIPFRONT_INLINE Real polynomial(const Real (&c)[terms], Real x) {
  if constexpr (k + 1 < terms)
    return c[k] + x * polynomial<k + 1>(c, x);
  else
    return c[k];
}

/// Like `polynomial`, but sums pairs, then pairs of pairs, and so on. This takes a few more operations, but the
/// processor need not wait for one before it begins the next. Use it for a single polynomial in a long loop. Several
/// polynomials in one loop keep the processor busy without it.
template <std::size_t first, std::size_t size, class Real, std::size_t terms>
SLIPFRONT_INLINE Real sum_of_pairs(const Real (&c)[terms], const Real (&powers)[4]) {
  if constexpr (size == 1) {
    return c[first];
  } else {
    constexpr std::size_t level = size > 8 ? 3 : size > 4 ? 2 : size > 2 ? 1 : 0, half = std::size_t{1} << level;
    return sum_of_pairs<first, half>(c, powers) + powers[level] * sum_of_pairs<first + half, size - half>(c, powers);
  }
}
template <class Real, std::size_t terms>
SLIPFRONT_INLINE Real polynomial_by_pairs(const Real (&c)[terms], Real x) {
  static_assert(terms <= 16);
  Real powers[4] = {x};
  for (std::size_t k = 1; k < 4; ++k) powers[k] = powers[k - 1] * powers[k - 1];
  return sum_of_pairs<0, terms>(c, powers);
}

/// Coefficients of (2 atanh(h) / h - 2) / h^2 in powers of h^2, for h^2 < 0.0413. The error is 1.9e-17
/// (tests/reference/fit_elliptic.py, atanh_tail).
inline constexpr double twice_atanh_tail[] = {
    6.6666666666674268e-1, 3.9999999995325112e-1, 2.8571429543072803e-1, 2.2222126616831090e-1,
    1.8186835381100079e-1, 1.5240743789841894e-1, 1.5440542329346171e-1,
};

/// Computes ln(a / b) / 2 for a >= b > 0. The caller gives a - b without cancellation. The caller also passes 1 / below
/// to half_log, so that it can compute this and another quotient with one division.
struct LogRatio {
  double above, below, halvings;
  SLIPFRONT_INLINE LogRatio(double a, double b, double a_less_b) {
    // The difference between the bit patterns of two doubles approximates the binary logarithm of their ratio, to 0.09.
    // Rounded, it is the exponent e in a / b = 2^e f with f in [2/3, 3/2].
    const std::uint64_t e =
        (std::bit_cast<std::uint64_t>(a) - std::bit_cast<std::uint64_t>(b) + 0x0008000000000000u) >> 52;
    const double lifted = std::bit_cast<double>(std::bit_cast<std::uint64_t>(b) + (e << 52));
    above = e == 0 ? a_less_b : a - lifted;
    below = a + lifted;
    halvings = std::bit_cast<double>(e | 0x4330000000000000u) - 4503599627370496.0;
  }
  SLIPFRONT_INLINE double half_log(double per_below) const {
    constexpr double half_ln2 = 0.34657359027997264;
    const double h = above * per_below, z = h * h;
    return halvings * half_ln2 + (h + h * (z * (polynomial_by_pairs(twice_atanh_tail, z) / 2)));
  }
};

/// Parts of exp(x) = power + power e.
struct ExpParts {
  double power, e;
};
SLIPFRONT_INLINE ExpParts exp_parts(double x) {
  constexpr double magic = 6755399441055744.0;  // adding it rounds to a whole number
  const double shifted = x * 1.4426950408889634 + magic, k = shifted - magic;
  const double r = (x - k * 6.93147180369123816490e-01) - k * 1.90821492927058770002e-10;
  constexpr double c[] = {1.0 / 2,     1.0 / 6,      1.0 / 24,      1.0 / 120,      1.0 / 720,       1.0 / 5040,
                          1.0 / 40320, 1.0 / 362880, 1.0 / 3628800, 1.0 / 39916800, 1.0 / 479001600, 1.0 / 6227020800};
  const double e = r + r * r * polynomial_by_pairs(c, r);
  const double power = std::bit_cast<double>((std::bit_cast<std::uint64_t>(shifted) + 1023) << 52);  // 2^k
  return {power, e};
}

/// exp(x) for |x| < 700.
SLIPFRONT_INLINE double exp_branch_free(double x) {
  const ExpParts at = exp_parts(x);
  return at.power + at.power * at.e;
}

/// exp(x) - 1 for |x| < 700.
SLIPFRONT_INLINE double expm1_branch_free(double x) {
  const ExpParts at = exp_parts(x);
  return at.power * at.e + (at.power - 1);
}

/// ln x for a normal x > 0, from x = 2^e f with f within a factor of sqrt(2) of 1.
SLIPFRONT_INLINE double log_branch_free(double x) {
  const std::uint64_t lifted = std::bit_cast<std::uint64_t>(x) + (0x3ff0000000000000u - 0x3fe6a09e667f3bcdu);
  const double e = std::bit_cast<double>((lifted >> 52) | 0x4330000000000000u) - (4503599627370496.0 + 1023.0);
  const double f = std::bit_cast<double>((lifted & 0x000fffffffffffffu) + 0x3fe6a09e667f3bcdu);
  const double h = (f - 1) / (f + 1), z = h * h;
  const double log_f = h * (2 + z * polynomial_by_pairs(twice_atanh_tail, z));
  return e * 6.93147180369123816490e-01 + (log_f + e * 1.90821492927058770002e-10);
}

/// Parts of asinh x = 2 half_log(1 / below) for 0 <= x < 1e150, precise also for tiny x. The caller gives
/// root = (1 + x^2)^(1/2). We use asinh x = ln(1 + up) with up = x + (root - 1).
SLIPFRONT_INLINE LogRatio asinh_ratio(double x, double root) {
  constexpr double c[] = {1.0 / 2, -1.0 / 8, 1.0 / 16, -5.0 / 128}, few = 1.0 / 4096;
  const double z = x * x, small = z < few ? z : few;
  const double up = x + (z < few ? small * polynomial(c, small) : root - 1);
  return {1 + up, 1, up};
}
SLIPFRONT_INLINE double asinh_branch_free(double x, double root) {
  const LogRatio ratio = asinh_ratio(x, root);
  return 2 * ratio.half_log(1 / ratio.below);
}

}  // namespace slipfront
