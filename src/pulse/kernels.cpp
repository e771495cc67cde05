#include "kernels.hpp"

#include <cmath>
#include <initializer_list>

#include "branch_free.hpp"
#include "vector_code.hpp"
#include "weno.hpp"

namespace slipfront::pulse {

namespace {

inline double curvature(const double* f) {
  const double d0 = f[-2] - 2 * f[-1] + f[0], d1 = f[-1] - 2 * f[0] + f[1], d2 = f[0] - 2 * f[1] + f[2];
  const double fourth = std::fabs(d0 - 2 * d1 + d2), second = std::fabs(d0) + 2 * std::fabs(d1) + std::fabs(d2);
  return fourth < 0.5 * second ? d1 / 24 : 0.0;
}

}  // namespace

SLIPFRONT_CLONES void centre_values(std::size_t size, const double* averages, double* values) {
  SLIPFRONT_INDEPENDENT
  for (std::size_t i = 2; i < size - 2; ++i) values[i] = averages[i] - curvature(averages + i);
  for (const std::size_t i : {std::size_t{0}, std::size_t{1}, size - 2, size - 1}) values[i] = averages[i];
}

SLIPFRONT_CLONES void cell_means(std::size_t size, const double* values, double* averages) {
  SLIPFRONT_INDEPENDENT
  for (std::size_t i = 2; i < size - 2; ++i) averages[i] = values[i] + curvature(values + i);
  for (const std::size_t i : {std::size_t{0}, std::size_t{1}, size - 2, size - 1}) averages[i] = values[i];
}

SLIPFRONT_CLONES void weno_faces(std::size_t faces, const double* plus, const double* minus, double scale, double* phi,
                                 double* psi) {
  SLIPFRONT_INDEPENDENT
  for (std::size_t f = 0; f < faces; ++f) {
    const double* p = plus + f;
    const double* m = minus + f;
    const double from_left = weno5(p[-3], p[-2], p[-1], p[0], p[1]), from_right = weno5(m[2], m[1], m[0], m[-1], m[-2]);
    phi[f] = (from_left + from_right) / 2 * scale;
    const double half = (from_left - from_right) / 2;
    psi[f] = (half > 0 ? half : 0.0) * scale;
  }
}

SLIPFRONT_CLONES void face_fluxes(std::size_t faces, const double* phi, const double* psi, double* U, double* p) {
  SLIPFRONT_INDEPENDENT
  for (std::size_t f = 0; f < faces; ++f) {
    const double sinh_psi = sinh_branch_free(psi[f]);
    U[f] = tanh_branch_free(phi[f]);
    p[f] = 2 * sinh_psi * sinh_psi;
  }
}

}  // namespace slipfront::pulse
