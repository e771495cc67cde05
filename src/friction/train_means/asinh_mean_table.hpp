#pragma once

#include <cmath>
#include <cstddef>
#include <vector>

#include "friction/train_means/chebyshev_patch.hpp"

namespace slipfront::friction {

/// The mean of asinh(A r) over slip where it is neither logarithmic (A s large) nor in trains that are too dense or too
/// empty for the table, r being the slip velocity over the fastest and s its least value. With x = A (1 + s) / 2 it is
/// asinh(x) plus a small difference, which this table has as a polynomial in ln A and ln s on each of its patches: the
/// mean is good to 3e-10 of itself. Made when first asked for, in some milliseconds.
class AsinhMeanTable {
 public:
  static const AsinhMeanTable& get();

  static constexpr double least_s = 1e-4, largest_s = 0.9;
  static constexpr double largest_As = 17;
  static constexpr double least_log_A = -10;  ///< below it the difference is proportional to A
  /// Values and slopes over ln A of `size` trains; A >= e^-650.
  void look_up(std::size_t size, const double* log_A, const double* A, const double* s, double* mean,
               double* slope) const;

 private:
  AsinhMeanTable();
  static constexpr double side = 0.46;  ///< of a patch
  static std::size_t patches_in(double range) { return static_cast<std::size_t>(std::ceil(range / side + 1e-9)); }
  std::size_t columns_;
  std::vector<ChebyshevPatch> patches_;  ///< of ln A and ln s
};

}  // namespace slipfront::friction
