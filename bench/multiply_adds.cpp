#include "multiply_adds.hpp"

#include "math/simd/vector_code.hpp"

SLIPFRONT_CLONES void multiply_adds(double* v, std::size_t n, double a, double b) {
  SLIPFRONT_INDEPENDENT
  for (std::size_t j = 0; j < n; ++j) {
    double p = v[j], q = p + b, r = p - b, s = q + a;
    for (int k = 0; k < 8; ++k) {
      p = p * a + b;
      q = q * a + b;
      r = r * a + b;
      s = s * a + b;
    }
    v[j] = (p + q) + (r + s);
  }
}
