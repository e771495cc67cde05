#include "inference/sampling/pareto.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace slipfront::inference {
namespace {

/// Mean of ln(1 + a x).
double shape_at(const std::vector<double>& x, double a) {
  double sum = 0;
  for (const double value : x) sum += std::log1p(a * value);
  return sum / static_cast<double>(x.size());
}

/// Shape of the generalised Pareto distribution of `x` > 0, ascending: the mean over a profile likelihood, drawn
/// towards 0.5 by ten more values.
double fitted_shape(const std::vector<double>& x) {
  const auto n = static_cast<double>(x.size());
  const double quartile = x[(x.size() + 2) / 4 - 1], largest = x.back();
  const int points = 30 + static_cast<int>(std::sqrt(n));
  std::vector<double> a, likelihood;
  for (int j = 1; j <= points; ++j) {
    a.push_back((std::sqrt(points / (j - 0.5)) - 1) / (3 * quartile) - 1 / largest);
    const double k = shape_at(x, a.back());
    likelihood.push_back(n * (std::log(a.back() / k) - k - 1));
  }
  const double most = *std::max_element(likelihood.begin(), likelihood.end());
  double sum = 0, mean = 0;
  for (std::size_t j = 0; j < a.size(); ++j) {
    const double weight = std::exp(likelihood[j] - most);
    sum += weight;
    mean += weight * a[j];
  }
  return (n * shape_at(x, mean / sum) + 10 * 0.5) / (n + 10);
}

}  // namespace

double pareto_k(std::vector<double> weights) {
  if (weights.size() < 25) return std::numeric_limits<double>::infinity();
  const auto n = static_cast<double>(weights.size());
  const auto tail = static_cast<std::ptrdiff_t>(std::fmin(n / 5, 3 * std::sqrt(n)));
  std::nth_element(weights.begin(), weights.end() - tail - 1, weights.end());
  const double cutoff = *(weights.end() - tail - 1);
  // Weights of a heavy tail differ by far more: 95 of them by a factor of 24 at k = 0.7.
  if (*std::max_element(weights.end() - tail, weights.end()) < 2 * cutoff) return 0;
  std::vector<double> above;
  for (auto w = weights.end() - tail; w != weights.end(); ++w)
    if (*w > cutoff * (1 + 1e-9)) above.push_back(*w - cutoff);
  if (above.size() < 5) return 0;
  std::sort(above.begin(), above.end());
  return fitted_shape(above);
}

double most_pareto_k(double samples) { return std::fmin(0.7, 1 - 1 / std::log10(samples)); }

}  // namespace slipfront::inference
