#pragma once

#include <cstddef>
#include <vector>

#include "slipfront/friction/law.hpp"

namespace slipfront::friction {

/// A curve that the user draws, whose every value may be a call of a formula, as polynomials: sixteen pieces to each
/// doubling of the speed. The curve itself is evaluated where a polynomial is not as good as the curve's rounding,
/// because the curve has a kink there, ends or fails, and at rest and speeds outside the pieces.
class TabulatedCurve {
 public:
  explicit TabulatedCurve(Curve curve);
  void values(std::size_t size, const double* speed, double* value) const;

  /// Coefficients of powers of -1 to 1 across the piece; the first is not a number where the curve is evaluated.
  struct Piece {
    static constexpr std::size_t terms = 8;
    double c[terms];
  };

 private:
  Curve curve_;
  double at_rest_;
  std::vector<Piece> pieces_;  ///< the last one is for speeds outside the others
};

}  // namespace slipfront::friction
