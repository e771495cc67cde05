#include "math/simd/vector_code.hpp"

namespace slipfront {

SLIPFRONT_CLONES void multiply(std::size_t size, const double* by, double* values) {
  SLIPFRONT_INDEPENDENT
  for (std::size_t i = 0; i < size; ++i) values[i] *= by[i];
}

SLIPFRONT_CLONES void divide(std::size_t size, const double* values, const double* by, double* quotients) {
  SLIPFRONT_INDEPENDENT
  for (std::size_t i = 0; i < size; ++i) quotients[i] = values[i] / by[i];
}

SLIPFRONT_CLONES void combine3(std::size_t size, std::array<double, 3> c, std::array<const double*, 3> x, double* sum) {
  const auto [x0, x1, x2] = x;
  SLIPFRONT_INDEPENDENT
  for (std::size_t i = 0; i < size; ++i) sum[i] = c[0] * x0[i] + c[1] * x1[i] + c[2] * x2[i];
}

SLIPFRONT_CLONES void combine5(std::size_t size, std::array<double, 5> c, std::array<const double*, 5> x, double* sum) {
  const auto [x0, x1, x2, x3, x4] = x;
  SLIPFRONT_INDEPENDENT
  for (std::size_t i = 0; i < size; ++i)
    sum[i] = c[0] * x0[i] + c[1] * x1[i] + c[2] * x2[i] + c[3] * x3[i] + c[4] * x4[i];
}

}  // namespace slipfront
