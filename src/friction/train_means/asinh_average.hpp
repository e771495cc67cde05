#pragma once

#include <cmath>
#include <cstddef>
#include <vector>

#include "friction/train_means/chebyshev.hpp"
#include "math/simd/elementary.hpp"
#include "slipfront/friction/law.hpp"

namespace slipfront::friction {

/// The force f = a asinh(w G), G = exp(base + share ln theta), of a position whose state is theta.
struct AsinhForce {
  double a = 0;
  double base = 0;
  double share = 0;

  /// Whether G is theta itself.
  bool is_of_G() const { return base == 0 && share == 1; }
  double exponent(double theta) const { return base + share * std::log(theta); }
  SLIPFRONT_INLINE double exponent_branch_free(double theta) const {
    return base + share * log_branch_free(at_least(theta, least_theta));
  }

  static constexpr double least_theta = 1e-300;
};

/// Table of the mean of asinh(A r) over slip, where r is the slip velocity over the fastest and s is the least r. It
/// covers trains that are neither too dense nor too empty, and in which the mean is not yet logarithmic (A s large).
/// With x = A (1 + s) / 2, the mean is asinh(x) plus a small difference. The table stores this difference as a
/// polynomial in ln A and ln s on each patch. The relative error of the mean is 3e-10. The first use computes the
/// table, in some milliseconds.
class AsinhMeanTable {
 public:
  static const AsinhMeanTable& get();

  static constexpr double least_s = 1e-4, largest_s = 0.9;
  static constexpr double largest_As = 17;
  static constexpr double least_log_A = -10;  ///< below it the difference is proportional to A
  /// Computes the mean and its slope over ln A for `size` trains, at most PhaseNodes::most. Requires A >= e^-650.
  void look_up(std::size_t size, const double* log_A, const double* A, const double* s, double* mean,
               double* slope) const;

 private:
  AsinhMeanTable();
  static constexpr double side = 0.46;  ///< size of a patch in ln A and in ln s
  static std::size_t patches_in(double range) { return static_cast<std::size_t>(std::ceil(range / side + 1e-9)); }
  std::size_t columns_;
  std::vector<ChebyshevPatch> patches_;  ///< polynomials in ln A and ln s
};

/// Averages of f = a asinh(w G) over a train whose positions have the same theta.
class AsinhAverage final : public QuadratureAverage {
 public:
  AsinhAverage(const Law& law, const AsinhForce& force) : QuadratureAverage(law), force_(force) {}
  double mean_strength(const State& train, double contact, Closure closure, LocalState theta) const override;
  void mean_strengths(const Trains& trains, Closure closure, double* mean, double* slope) const override;

 private:
  AsinhForce force_;
};

}  // namespace slipfront::friction
