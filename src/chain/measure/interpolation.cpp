#include "chain/measure/interpolation.hpp"

#include <algorithm>
#include <cmath>

#include "foundation/math/lagrange.hpp"
#include "foundation/text/digits.hpp"
#include "slipfront/error.hpp"

namespace slipfront::chain {

double interpolated(const std::vector<double>& v, double r) {
  const long n = static_cast<long>(v.size()), points = std::min<long>(6, n);
  const long first = std::clamp<long>(static_cast<long>(std::floor(r)) - points / 2 + 1, 0, n - points);
  const auto weights = equidistant_weights(static_cast<std::size_t>(points), r - static_cast<double>(first));
  double sum = 0;
  for (std::size_t j = 0; j < static_cast<std::size_t>(points); ++j)
    sum += weights[j] * v[static_cast<std::size_t>(first) + j];
  return sum;
}

double integral(const std::vector<double>& v, double from, double to) {
  double sum = 0;
  for (double a = from; a < to;) {  // Gauss-Legendre with three points in every interval of the grid
    const double b = std::fmin(std::floor(a) + 1, to), middle = (a + b) / 2, half = (b - a) / 2;
    const double node = std::sqrt(0.6) * half;
    sum += half *
           (5 * interpolated(v, middle - node) + 8 * interpolated(v, middle) + 5 * interpolated(v, middle + node)) / 9;
    a = b;
  }
  return sum;
}

void refuse_window(const Grid& grid, double x, double width) {
  throw InputError({.key = "window",
                    .value = digits(x) + " +- " + digits(width / 2),
                    .problem = "not on the chain",
                    .allowed = digits(grid.left) + " to " + digits(grid.x(grid.sites - 1))});
}

}  // namespace slipfront::chain
