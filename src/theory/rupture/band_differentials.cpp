#include "theory/rupture/band_differentials.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numbers>

#include "math/interpolation.hpp"

namespace slipfront::rupture {
namespace {

using std::numbers::pi;

constexpr double unbounded = std::numeric_limits<double>::infinity();

/// 1 - product of (1 - part) for parts between 0 and 1, and product of (1 + part) - 1. Neither cancels.
void add_loss(double& loss, double part) { loss += (1 - loss) * part; }
void add_gain(double& gain, double part) { gain += (1 + gain) * part; }
/// 1 - root, where root^2 = 1 - loss, and sqrt(1 + gain) - 1.
double loss_of_root(double loss, double root) { return loss / (1 + root); }
double gain_of_root(double gain) { return gain / (1 + std::sqrt(1 + gain)); }

}  // namespace

BandDifferentials::BandDifferentials(std::span<const double> widths)
    : trains_((widths.size() + 1) / 2),
      edges_(widths.size() + 1),
      offset_(edges_),
      lambda_(edges_),
      apart_(edges_ * edges_) {
  double bands = 0, below = 0;
  for (std::size_t i = 0; i < widths.size(); ++i) {
    total_ += widths[i];
    if (i % 2 == 0) bands += widths[i];
  }
  offset_[0] = -total_ / 2;
  for (std::size_t i = 0; i < widths.size(); ++i) offset_[i + 1] = (below += widths[i]) - total_ / 2;
  for (std::size_t i = 0; i < edges_; ++i) lambda_[i] = std::exp(2 * offset_[i]);
  for (std::size_t i = 0; i < edges_; ++i) {
    double between = 0;
    for (std::size_t j = i + 1; j < edges_; ++j) {
      between += widths[j - 1];
      apart_[i * edges_ + j] = apart_[j * edges_ + i] = lambda_[i] * std::expm1(2 * between);
    }
  }
  kappa_ = std::exp(bands);
  wide_ = total_ > 1;
  for (std::size_t n = 1; n < trains_; ++n)
    if (widths[2 * n - 1] > 1) screen_ = n;
  solve(bands);
  take_upper_edges();
}

double BandDifferentials::distance(const Point& at, std::size_t edge) const {
  return edge < at.edges ? at.below + (edge + 1 == at.edges ? 0 : apart(edge, at.edges - 1))
                         : at.above + (edge == at.edges ? 0 : apart(at.edges, edge));
}

double BandDifferentials::gap_weight(const Point& at) const {
  double square = 1;
  for (std::size_t n = 0; n < edges_; n += 2) square *= distance(at, n) / distance(at, n + 1);
  return std::sqrt(square);
}

BandDifferentials::Values BandDifferentials::values(const Point& at) const {
  const double pole = pole_at_0(at);
  const double top = pole_at_infinity(at);
  double p = (top - pole) / 2, w = (top + pole) / 2;
  for (std::size_t n = 0; n < trains_; ++n) {
    const double to_edge = 2 * n < at.edges ? distance(at, 2 * n) : -distance(at, 2 * n);
    p += alpha_[n] / to_edge;
    w += beta_[n] / to_edge;
  }
  return {p, w};
}

BandDifferentials::Point BandDifferentials::point(const RulePoint& at, std::size_t edges) const {
  return {lambda_[edges - 1] + at.from_a, edges, at.from_a, at.to_b};
}

/// The rule between edges `low` and low + 1. The neighbours of the lowest and highest edge are lambda = 0 and infinity.
std::vector<RulePoint> BandDifferentials::rule(std::size_t low) const {
  return interval_rule({.width = apart(low, low + 1),
                        .from_a_out = low > 0 ? apart(low - 1, low) : lambda_[0],
                        .to_b_out = low + 2 < edges_ ? apart(low + 1, low + 2) : unbounded});
}

void BandDifferentials::solve(double bands) {
  matrix_.assign(trains_ * trains_, 0);
  alpha_.assign(trains_, 0);
  beta_.assign(trains_, 0);
  add_lowest_gap(bands);
  add_inner_gaps();
  solve_linear(matrix_, {&alpha_, &beta_});
}

/// In the lowest gap, lambda = E_1 sn^2. From dp and dw we subtract functions with their poles at r = -infinity, which
/// vanish at E_1: X = sqrt(1 / lambda - 1 / E_1) / 2 from p, and -X from w. For narrow states we subtract
/// Y = -sqrt((E_1 - lambda) (U_N - lambda) / lambda) / 2 from w, because w - Y is as small as the widths.
void BandDifferentials::add_lowest_gap(double bands) {
  const std::size_t N = trains_;
  const double lowest = lambda_[0], root_lowest = std::sqrt(lowest), lowest_minus_1 = std::expm1(-total_),
               nu_minus_1 = std::expm1(bands - total_), kappa_minus_lowest = std::expm1(bands) - lowest_minus_1;
  const MidpointGrid grid = midpoint_grid(lowest / lambda_[1], std::sqrt(apart(0, 1) / lambda_[1]));
  for (const auto& [sn2, cn2, dn2] : grid.at) {
    const Point at{lowest * sn2, 0, lowest * sn2, lowest * cn2};
    const double weight = root_lowest * std::sqrt(cn2) * std::sqrt(dn2) * grid.step();  // d lambda / (2 sqrt(lambda))
    const double G = gap_weight(at), to_highest = distance(at, edges_ - 1);
    double gap_gain = 0, gap_gain_from_0 = 0;
    for (std::size_t n = 0; n < N; ++n) {
      matrix_[n] += weight * G / distance(at, 2 * n);
      if (n + 1 == N) break;
      const double part = apart(2 * n + 1, 2 * n + 2) / distance(at, 2 * n + 1);
      add_gain(gap_gain, part);
      add_gain(gap_gain_from_0, at.lambda / lambda_[2 * n + 2] * part);
    }
    if (wide_) {
      add_gain(gap_gain_from_0, at.lambda / to_highest);
      const double rest = gain_of_root(gap_gain_from_0) / (at.lambda * std::sqrt(cn2));
      const double top = pole_at_infinity(at) * G;
      alpha_[0] += weight / 2 * (top - rest);
      beta_[0] += weight / 2 * (top + rest);
    } else {
      alpha_[0] += weight / 2 * (G + loss_at_lowest_edge(at, G, sn2, cn2));
      const double gain = gain_of_root(gap_gain);
      // Two forms of the same difference: the first is precise for small lambda, the second next to the edge.
      const double from_gaps = sn2 < 0.5
                                   ? gain_of_root(gap_gain_from_0) - at.lambda * at.lambda * gain
                                   : gain * (at.above - lowest_minus_1) * (1 + at.lambda) + (1 + gain) * nu_minus_1;
      beta_[0] += weight / (2 * at.lambda * std::sqrt(at.above) * std::sqrt(to_highest)) *
                  (from_gaps - (1 + gain) * at.lambda * kappa_minus_lowest);
    }
  }
}

void BandDifferentials::add_inner_gaps() {
  const std::size_t N = trains_;
  for (std::size_t m = 1; m < N; ++m) {
    for (const RulePoint& node : rule(2 * m - 1)) {
      const Point at = point(node, 2 * m);
      const double weight = node.weight * gap_weight(at) / (2 * std::sqrt(at.lambda));
      for (std::size_t n = 0; n < N; ++n)
        matrix_[m * N + n] += weight / (n < m ? distance(at, 2 * n) : -distance(at, 2 * n));
      const double pole = pole_at_0(at), top = pole_at_infinity(at);
      alpha_[m] -= weight * (top - pole) / 2;
      beta_[m] -= weight * (top + pole) / 2;
    }
  }
}

/// The part of f_w - f_p with the pole at lambda = 0.
double BandDifferentials::pole_at_0(const Point& at) const {
  return wide_ ? -kappa_ * lambda_[0] / (at.lambda * (at.edges > 0 ? distance(at, 0) : -distance(at, 0)))
               : kappa_ / at.lambda;
}

/// The part of f_w + f_p with the pole at infinity.
double BandDifferentials::pole_at_infinity(const Point& at) const {
  if (screen_ == 0) return 1;
  const std::size_t edge = 2 * screen_;
  return edge < at.edges ? at.lambda / distance(at, edge) : -at.lambda / distance(at, edge);
}

/// (1 - kappa G sqrt(1 - t)) / (lambda sqrt(1 - t)) in the lowest gap, with t = lambda / E_1 = sn^2.
double BandDifferentials::loss_at_lowest_edge(const Point& at, double G, double sn2, double cn2) const {
  double loss = sn2;
  for (std::size_t n = 0; n < trains_; ++n)
    add_loss(loss, at.lambda * apart(2 * n, 2 * n + 1) / (lambda_[2 * n] * distance(at, 2 * n + 1)));
  return loss_of_root(loss, kappa_ * G * std::sqrt(cn2)) / (at.lambda * std::sqrt(cn2));
}

void BandDifferentials::take_upper_edges() {
  f_p_.resize(edges_);
  f_w_.resize(edges_);
  for (std::size_t n = 0; n < trains_; ++n) {
    const double of_pole = wide_ && n == 0 ? kappa_ / 2 : 0;
    const double of_top = screen_ > 0 && n == screen_ ? lambda_[2 * n] / 2 : 0;
    f_p_[2 * n] = alpha_[n] + of_top + of_pole;
    f_w_[2 * n] = beta_[n] + of_top - of_pole;
    const std::size_t upper = 2 * n + 1;
    const auto [p, w] = values({lambda_[upper], upper, apart(upper - 1, upper), 0});
    f_p_[upper] = p;
    f_w_[upper] = w;
  }
}

double BandDifferentials::speed_inside(std::size_t band, double from_low) const {
  const std::size_t low = 2 * band;
  const double width = apart(low, low + 1), below = lambda_[low] * std::expm1(2 * from_low);
  const auto [p, w] = values({lambda_[low] + below, low + 1, below, width - below});
  return w / p;
}

BandIntegrals BandDifferentials::over_band(std::size_t band) const {
  const std::size_t low = 2 * band;
  const double low_minus_1 = std::expm1(2 * offset_[low]);
  BandIntegrals sum{};
  for (const RulePoint& node : rule(low)) {
    const Point at = point(node, low + 1);
    const double root = std::sqrt(at.lambda), weight = node.weight * gap_weight(at) / (2 * root);
    const auto [p, w] = values(at);
    const double dp = weight * p, dw = weight * w;
    const double cosh_r = (1 + at.lambda) / (2 * root), sinh_r = (low_minus_1 + node.from_a) / (2 * root);
    sum.dp += dp;
    sum.dw += dw;
    sum.cosh_dp += cosh_r * dp;
    sum.sinh_dp += sinh_r * dp;
    sum.sinh_dw += sinh_r * dw;
  }
  return sum;
}

/// Lowest gap: p = X + rest, w = -X + rest, and the finite part of the integral of X dr is -(pi / 4) / sqrt(E_1).
GapIntegral BandDifferentials::over_lowest_gap() const {
  const std::size_t N = trains_;
  const double lowest = lambda_[0];
  const MidpointGrid grid = midpoint_grid(lowest / lambda_[1], std::sqrt(apart(0, 1) / lambda_[1]), Resolution::series);
  const std::vector<double> weights = log_sn_weights(grid);
  double p_sum = -pi / (4 * std::sqrt(lowest)), w_sum = -p_sum;
  for (std::size_t j = 0; j < weights.size(); ++j) {
    const auto& [sn2, cn2, dn2] = grid.at[j];
    const Point at{lowest * sn2, 0, lowest * sn2, lowest * cn2};
    const double weight = weights[j] * grid.step() * std::sqrt(lowest) * std::sqrt(cn2) * std::sqrt(dn2);
    const double G = gap_weight(at);
    double p = 0, w = 0, gain = 0;
    for (std::size_t n = 0; n < N; ++n) {
      const double to_upper = distance(at, 2 * n + 1);
      p -= alpha_[n] / distance(at, 2 * n);
      w -= beta_[n] / distance(at, 2 * n);
      add_gain(gain, n + 1 < N ? at.lambda / lambda_[2 * n + 2] * apart(2 * n + 1, 2 * n + 2) / to_upper
                               : at.lambda / to_upper);
    }
    const double rest =
        wide_ ? -gain_of_root(gain) / (at.lambda * std::sqrt(cn2)) : loss_at_lowest_edge(at, G, sn2, cn2);
    const double top = pole_at_infinity(at) * G;
    p_sum += weight * (p * G + (top + rest) / 2);
    w_sum += weight * (w * G + (top - rest) / 2);
  }
  return {p_sum, w_sum};
}

/// An inner gap: by parts, as p vanishes at both ends.
GapIntegral BandDifferentials::over_inner_gap(std::size_t m) const {
  double p_sum = 0, w_sum = 0;
  for (const RulePoint& node : rule(2 * m - 1)) {
    const Point at = point(node, 2 * m);
    const double from_low = std::log1p(at.below / lambda_[2 * m - 1]) / 2;
    const double weight = from_low * node.weight * gap_weight(at) / (2 * std::sqrt(at.lambda));
    const auto [p, w] = values(at);
    p_sum -= weight * p;
    w_sum -= weight * w;
  }
  return {p_sum, w_sum};
}

/// Highest gap: lambda = U_N / sn^2, and X = sqrt(lambda - U_N) / 2 for both.
GapIntegral BandDifferentials::over_highest_gap() const {
  const std::size_t N = trains_;
  const std::size_t last = edges_ - 1;
  const double lowest = lambda_[0], highest = lambda_[last];
  const MidpointGrid grid =
      midpoint_grid(lambda_[last - 1] / highest, std::sqrt(apart(last - 1, last) / highest), Resolution::series);
  const std::vector<double> weights = log_sn_weights(grid);
  double p_sum = -pi / 4 * std::sqrt(highest), w_sum = p_sum;
  for (std::size_t j = 0; j < weights.size(); ++j) {
    const auto& [sn2, cn2, dn2] = grid.at[j];
    const Point at{highest / sn2, edges_, highest * cn2 / sn2, 0};
    const double weight = weights[j] * grid.step() * std::sqrt(highest) * std::sqrt(cn2) * std::sqrt(dn2) / sn2;
    const double G = gap_weight(at);
    double loss = lowest / at.lambda, p = screen_ > 0 ? lambda_[2 * screen_] / (2 * distance(at, 2 * screen_)) : 0,
           w = p;
    for (std::size_t n = 0; n < N; ++n) {
      if (n + 1 < N) add_loss(loss, apart(2 * n + 1, 2 * n + 2) / distance(at, 2 * n + 1));
      p += alpha_[n] / distance(at, 2 * n);
      w += beta_[n] / distance(at, 2 * n);
    }
    const double rest = loss_of_root(loss, G * std::sqrt(cn2)) / std::sqrt(cn2), pole = pole_at_0(at) * G;
    p_sum -= weight * (p * G - (rest + pole) / 2);
    w_sum -= weight * (w * G - (rest - pole) / 2);
  }
  return {p_sum, w_sum};
}

GapIntegrals BandDifferentials::over_gaps() const {
  GapIntegrals result;
  const auto add = [&result](const GapIntegral& gap) {
    result.p.push_back(gap.p);
    result.w.push_back(gap.w);
  };
  add(over_lowest_gap());
  for (std::size_t m = 1; m < trains_; ++m) add(over_inner_gap(m));
  add(over_highest_gap());
  return result;
}

EdgeStrength BandDifferentials::strength(std::size_t j) const {
  double square = 0.5;
  for (std::size_t n = 0; n < edges_; n += 2) {
    if (n != j) square *= apart(n, j);
    if (n + 1 != j) square /= apart(n + 1, j);
  }
  const double g = std::sqrt(square);
  return {f_p_[j] * g, f_w_[j] * g};
}

std::vector<std::vector<double>> BandDifferentials::normal_differentials() const {
  const std::size_t N = trains_;
  std::vector<std::vector<double>> result(edges_, std::vector<double>(N));
  for (std::size_t i = 0; i < N; ++i) {
    // Its integral is -1 over the gap below band i, 1 over that above, and 0 over the others.
    std::vector<double> gamma(N, 0.0);
    gamma[i] = i == 0 ? 1 : -1;  // the matrix has the lowest gap with the opposite sign
    if (i + 1 < N) gamma[i + 1] = 1;
    solve_linear(matrix_, {&gamma});
    for (std::size_t j = 0; j < edges_; ++j) {
      double f = j % 2 == 0 ? gamma[j / 2] : 0, square = 0.5;
      for (std::size_t n = 0; n < edges_; n += 2) {
        if (n != j) square *= apart(n, j);
        if (n + 1 != j) square /= apart(n + 1, j);
        if (j % 2 == 1) f += gamma[n / 2] / (n < j ? apart(n, j) : -apart(n, j));
      }
      result[j][i] = pi * std::sqrt(square) * f;
    }
  }
  return result;
}

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
