#include "theory/rupture/interval_rule.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numbers>

namespace slipfront::rupture {
namespace {

using std::numbers::pi;

double arithmetic_geometric_mean(double a, double b) {
  while (std::fabs(a - b) > 1e-8 * a) {  // the next mean has twice as many digits
    const double mean = (a + b) / 2;
    b = std::sqrt(a * b);
    a = mean;
  }
  return (a + b) / 2;
}

/// The moduli of Landen's transformation, until one is negligible: k_next = k^2 / (1 + k')^2. The same recursion with
/// k and k' exchanged serves the ascending form.
struct LandenChain {
  std::array<double, 8> moduli;
  std::size_t count = 0;
  double product = 1;  ///< the product of all 1 + k
};

LandenChain landen_chain(double k2, double other2, double negligible) {
  LandenChain chain{};
  double other = std::sqrt(other2);
  while (k2 > negligible && chain.count < chain.moduli.size()) {
    const double k = k2 / ((1 + other) * (1 + other));
    chain.moduli[chain.count++] = k;
    chain.product *= 1 + k;
    other = 2 * std::sqrt(other) / (1 + other);
    k2 = k * k;
  }
  return chain;
}

/// Descending form (Abramowitz & Stegun 16.12), from sin x and cos x.
EllipticSquares descend(const LandenChain& chain, double sin2, double cos2) {
  EllipticSquares e{sin2, cos2, 1};
  for (std::size_t i = chain.count; i-- > 0;) {
    const double k = chain.moduli[i], part = k * e.sn2, r = 1 / (1 + part), r2 = r * r;
    e = {(1 + k) * (1 + k) * e.sn2 * r2, e.cn2 * e.dn2 * r2, (1 - part) * (1 - part) * r2};
  }
  return e;
}

/// Ascending form (Abramowitz & Stegun 16.14), from tanh v and sech v. The moduli of the chain are complementary ones.
EllipticSquares ascend(const LandenChain& chain, double tanh2, double sech2) {
  EllipticSquares e{tanh2, sech2, sech2};
  for (std::size_t i = chain.count; i-- > 0;) {
    const double k = chain.moduli[i], less = (e.dn2 - k) / (1 - k), more = (e.dn2 + k) / (1 + k), r = 1 / e.dn2;
    e = {(1 + k) * (1 + k) * e.sn2 * e.cn2 * r, less * less * r, more * more * r};
  }
  return e;
}

/// Points per K / K'. An error of exp(-2 pi points) is below the rounding of doubles from 6 on. One more point allows
/// for poles on the edge of the strip.
constexpr double points_per_ratio = 7;

}  // namespace

MidpointGrid midpoint_grid(double m, double k1, Resolution resolution) {
  const double k = std::sqrt(m), m1 = k1 * k1;
  MidpointGrid grid;
  grid.K = pi / (2 * arithmetic_geometric_mean(1, k1));
  const double ratio = arithmetic_geometric_mean(1, k) / arithmetic_geometric_mean(1, k1);  // K / K'
  grid.log_nome = -pi / ratio;
  const std::size_t pairs =
      static_cast<std::size_t>(resolution) * (2 + static_cast<std::size_t>(std::ceil(points_per_ratio / 2 * ratio)));
  const std::size_t n = 2 * pairs;
  grid.at.resize(n);
  const auto place = [&](std::size_t j, const EllipticSquares& e) {
    grid.at[j] = e;
    grid.at[n - 1 - j] = {e.cn2 / e.dn2, m1 * e.sn2 / e.dn2, m1 / e.dn2};  // u -> K - u
  };
  if (m <= 0.5) {
    const LandenChain chain = landen_chain(m, m1, 1e-17);
    const double step = pi / (2 * static_cast<double>(n));
    double s = std::sin(step / 2), c = std::cos(step / 2);
    const double sin_step = 2 * s * c, cos_step = 1 - 2 * s * s;
    for (std::size_t j = 0; j < pairs; ++j) {
      place(j, descend(chain, s * s, c * c));
      const double next = s * cos_step + c * sin_step;
      c = c * cos_step - s * sin_step;
      s = next;
    }
  } else {
    // For u < K / 2, dn^2 is at least k', and k'^2 / 4 must be negligible next to it.
    const LandenChain chain = landen_chain(m1, m, 1e-34);
    const double step = grid.K / (static_cast<double>(n) * chain.product);
    const double rest_half = -std::expm1(-step), rest_step = -std::expm1(-2 * step);
    double e = 1 - rest_half, rest = rest_half;  // exp(-2 v) and 1 - exp(-2 v)
    for (std::size_t j = 0; j < pairs; ++j) {
      const double sum = 1 / (1 + e), tanh_v = rest * sum;
      place(j, ascend(chain, tanh_v * tanh_v, 4 * e * sum * sum));
      rest = rest * (1 - rest_step) + rest_step;
      e *= 1 - rest_step;
    }
  }
  return grid;
}

std::vector<RulePoint> interval_rule(const IntervalEnds& ends) {
  const double width = ends.width, low = ends.from_a_out, high = ends.to_b_out;
  // With cross-ratios, m = (b - a) (b_out - a_out) / ((b_out - a) (b - a_out)) and m1 its complement.
  const double to_low = std::isinf(low) ? 1 : low / (low + width);
  const double to_high = std::isinf(high) ? 1 : high / (high + width);
  const double m = std::isinf(low)    ? width / (high + width)
                   : std::isinf(high) ? width / (low + width)
                                      : width / (high + width) * ((high + width + low) / (low + width));
  const MidpointGrid grid = midpoint_grid(m, std::sqrt(to_low) * std::sqrt(to_high));
  // The second half follows from the first one by exchanging the ends, where 1 - m itself might underflow.
  const std::size_t n = grid.at.size();
  std::vector<RulePoint> points(n);
  const double step = 2 * width * grid.step(), rho = 1 / to_low, mirror_rho = 1 / to_high;
  for (std::size_t j = 0; j < n / 2; ++j) {
    const auto& [s, c, d] = grid.at[j];
    const double root = step * std::sqrt(s * c) * std::sqrt(d);
    const double r = 1 / (rho * c + s), mirror_r = 1 / (mirror_rho * c + s);
    points[j] = {width * s * r, width * rho * c * r, root * rho * r * r};
    points[n - 1 - j] = {width * mirror_rho * c * mirror_r, width * s * mirror_r,
                         root * mirror_rho * mirror_r * mirror_r};
  }
  return points;
}

std::vector<double> log_sn_weights(const MidpointGrid& grid) {
  // ln sn(2 K x / pi) = constant - sum_k (1 / k) (1 - q^k) / (1 + q^k) cos(2 k x), Whittaker & Watson 22.5
  const std::size_t n = grid.at.size();
  std::vector<double> coefficient(n, 0.0), weights(n);
  for (std::size_t k = 1; k < n; ++k)
    coefficient[k] = -std::tanh(static_cast<double>(k) * grid.log_nome / 2) / static_cast<double>(k);
  // Clenshaw's recurrences for the sums over even and over odd k of coefficient[k] cos(k y), for half of all y at once.
  // At pi - y the odd sum has the other sign.
  const std::size_t half = n / 2;
  std::vector<double> cos_y(half), twice_cos(half), even_1(half, 0.0), even_2(half, 0.0), odd_1(half, 0.0),
      odd_2(half, 0.0);
  for (std::size_t j = 0; j < half; ++j) {
    cos_y[j] = std::cos(pi * (static_cast<double>(j) + 0.5) / static_cast<double>(n));
    twice_cos[j] = 4 * cos_y[j] * cos_y[j] - 2;  // 2 cos(2 y)
  }
  for (std::size_t k = half; k-- > 0;)
    for (std::size_t j = 0; j < half; ++j) {
      const double even = coefficient[2 * k] + twice_cos[j] * even_1[j] - even_2[j];
      const double odd = coefficient[2 * k + 1] + twice_cos[j] * odd_1[j] - odd_2[j];
      even_2[j] = even_1[j];
      odd_2[j] = odd_1[j];
      even_1[j] = even;
      odd_1[j] = odd;
    }
  for (std::size_t j = 0; j < half; ++j) {
    const double even = even_1[j] - even_2[j] * twice_cos[j] / 2, odd = cos_y[j] * (odd_1[j] - odd_2[j]);
    weights[j] = even + odd;
    weights[n - 1 - j] = even - odd;
  }
  return weights;
}

}  // namespace slipfront::rupture
