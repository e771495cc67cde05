#include "lattice/chain/model/periodic_force.hpp"

#include <array>
#include <cmath>
#include <numbers>
#include <vector>

namespace slipfront::chain {
namespace {

using std::numbers::pi;

}  // namespace

PeriodicForce fit(const std::function<double(double)>& f) {
  // f = r (1/4 - r^2) q(r^2). We interpolate q at the Chebyshev nodes of 0 ... 1/4, which is nearly the best fit in the
  // maximum norm.
  constexpr int degree = PeriodicForce::terms - 1, nodes = degree;  // q has the degree `degree` - 1
  std::array<double, nodes> q{}, x{};
  for (int i = 0; i < nodes; ++i) {
    const auto at = static_cast<std::size_t>(i);
    x[at] = std::cos(pi * (i + 0.5) / nodes);
    const double z = (x[at] + 1) / 8, r = std::sqrt(z);
    q[at] = f(r) / (r * (0.25 - z));
  }
  // We compute the Chebyshev coefficients, convert them to powers of y = 8 z - 1 by the recurrence, and then to powers
  // of z.
  std::array<double, nodes> y_coefficients{}, t0{}, t1{};
  t0[0] = 1;
  t1[1] = 1;
  for (int k = 0; k < nodes; ++k) {
    double a = 0;
    for (int i = 0; i < nodes; ++i) a += q[static_cast<std::size_t>(i)] * std::cos(pi * k * (i + 0.5) / nodes);
    a *= (k == 0 ? 1.0 : 2.0) / nodes;
    for (std::size_t j = 0; j < nodes; ++j) y_coefficients[j] += a * t0[j];
    std::array<double, nodes> next{};
    for (std::size_t j = 0; j < nodes; ++j) next[j] = (j > 0 ? 2 * t1[j - 1] : 0.0) - t0[j];
    t0 = t1;
    t1 = next;
  }
  std::array<double, nodes> z_coefficients{};  // Horner in y = 8 z - 1
  for (std::size_t k = nodes; k-- > 0;) {
    std::array<double, nodes> next{};
    for (std::size_t j = 0; j < nodes; ++j) next[j] = (j > 0 ? 8 * z_coefficients[j - 1] : 0.0) - z_coefficients[j];
    next[0] += y_coefficients[k];
    z_coefficients = next;
  }
  PeriodicForce force;
  for (std::size_t j = 0; j < nodes; ++j) {
    force.c[j] += z_coefficients[j] / 4;
    force.c[j + 1] -= z_coefficients[j];
  }
  return force;
}

double force_seen_from(double z, double eps) {
  double u = z / (1 + eps * std::cos(2 * pi * z));
  for (int i = 0; i < 12; ++i) {
    const double step = (u + eps * std::sin(2 * pi * u) / (2 * pi) - z) / (1 + eps * std::cos(2 * pi * u));
    u -= step;
    if (std::fabs(step) < 1e-17) break;
  }
  return std::sin(2 * pi * u) / (2 * pi);
}

PeriodicForce substrate_force(double eps) {
  return fit([eps](double z) { return force_seen_from(z, eps); });
}

}  // namespace slipfront::chain
