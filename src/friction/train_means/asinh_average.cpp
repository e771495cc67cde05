#include "friction/train_means/asinh_average.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "friction/train_means/mean_over_train.hpp"
#include "math/simd/elementary.hpp"
#include "math/simd/vector_code.hpp"

namespace slipfront::friction {
namespace {

/// Adds the term of one phase node to the sums over the nodes, for many values of A.
SLIPFRONT_CLONES void add_asinh(std::size_t size, const double* A, double r, double weight, double* sum) {
  SLIPFRONT_INDEPENDENT
  for (std::size_t i = 0; i < size; ++i) {
    const double x = A[i] * r;
    sum[i] += weight * asinh_branch_free(x, std::sqrt(1 + x * x));
  }
}

constexpr std::size_t terms = ChebyshevPatch::terms;

}  // namespace

const AsinhMeanTable& AsinhMeanTable::get() {
  static const AsinhMeanTable table;
  return table;
}

AsinhMeanTable::AsinhMeanTable() {
  using Fit = ChebyshevPatch::Fit;
  const Fit through;
  const double first_s = std::log(least_s);
  columns_ = patches_in(std::log(largest_s) - first_s);
  const std::size_t rows = patches_in(std::log(largest_As / least_s) - least_log_A);
  patches_.assign(rows * columns_, {});
  const auto exp_of_node = [](double first, std::size_t patch, std::size_t k) {
    return std::exp(first + (static_cast<double>(patch) + (1 + Fit::extremum(k)) / 2) * side);
  };
  std::vector<double> A(rows * terms), sums[terms];
  for (std::size_t at = 0; at < A.size(); ++at) A[at] = exp_of_node(least_log_A, at / terms, at % terms);
  for (std::size_t column = 0; column < columns_; ++column) {
    double r[terms], weight[terms], s[terms], weights[terms] = {};
    for (std::size_t k = 0; k < terms; ++k) s[k] = exp_of_node(first_s, column, k);  // < 1
    const PhaseNodes phases(terms, s);
    // In the rows above these, the mean is logarithmic.
    const std::size_t needed = std::min(rows, patches_in(std::log(largest_As / s[terms - 1]) - least_log_A));
    for (std::vector<double>& sum : sums) sum.assign(needed * terms, 0);
    for (std::size_t p = 0; p < phases.count(); ++p) {
      phases.node(p, Closure::consistent, r, weight);
      for (std::size_t k = 0; k < terms; ++k) {
        weights[k] += weight[k];
        add_asinh(needed * terms, A.data(), r[k], weight[k], sums[k].data());
      }
    }
    for (std::size_t k = 0; k < terms; ++k)  // the table holds the difference from asinh(x)
      add_asinh(needed * terms, A.data(), (1 + s[k]) / 2, -weights[k], sums[k].data());
    for (std::size_t row = 0; row < needed; ++row) {
      ChebyshevPatch::Values values;
      for (std::size_t j = 0; j < terms; ++j)
        for (std::size_t k = 0; k < terms; ++k) values[j][k] = sums[k][row * terms + j] / weights[k];
      patches_[row * columns_ + column].fit(through, values);
    }
  }
}

namespace {

/// Positions of trains in the table.
struct PositionsInTable {
  static constexpr std::size_t most = PhaseNodes::most;
  double x_A[most], x_s[most];  ///< -1 to 1 within the patch
  int patch[most];
  double difference[most], by_A[most];  ///< value of the table at this position, and its slope over x_A
};

SLIPFRONT_CLONES void find_positions(std::size_t size, std::size_t columns, double first_s, double first_A, double side,
                                     const double* log_A, const double* s, PositionsInTable& at) {
  const double per_side = 1 / side;
  SLIPFRONT_INDEPENDENT
  for (std::size_t i = 0; i < size; ++i) {
    const double from = log_A[i] > first_A ? log_A[i] : first_A;
    const double row = (from - first_A) * per_side, column = (log_branch_free(s[i]) - first_s) * per_side;
    const int at_row = static_cast<int>(row), at_column = static_cast<int>(column);
    at.x_A[i] = 2 * (row - at_row) - 1;
    at.x_s[i] = 2 * (column - at_column) - 1;
    at.patch[i] = at_row * static_cast<int>(columns) + at_column;
  }
}

/// Interpolates for one train after the other, because gathering coefficients for many trains would take longer.
SLIPFRONT_CLONES void interpolate_all(std::size_t size, const ChebyshevPatch* patches, PositionsInTable& at) {
  for (std::size_t i = 0; i < size; ++i) {
    const ValueAndSlope found = interpolate(patches[at.patch[i]], at.x_A[i], at.x_s[i]);
    at.difference[i] = found.value;
    at.by_A[i] = found.by_x;
  }
}

SLIPFRONT_CLONES void add_to_asinh(std::size_t size, double first_A, double side, const double* A, const double* s,
                                   const PositionsInTable& at, double* mean, double* slope) {
  const double per_first = 1 / first_A, per_unit = 2 / side;
  SLIPFRONT_INDEPENDENT
  for (std::size_t i = 0; i < size; ++i) {
    const double x = A[i] * (1 + s[i]) / 2, root = std::sqrt(1 + x * x), value = at.difference[i];
    const bool slow = A[i] < first_A;
    const double share = slow ? A[i] * per_first : 1.0, by_A = at.by_A[i] * per_unit;
    mean[i] = asinh_branch_free(x, root) + share * value;
    slope[i] = x / root + share * (slow ? value : by_A);
  }
}

}  // namespace

void AsinhMeanTable::look_up(std::size_t size, const double* log_A, const double* A, const double* s, double* mean,
                             double* slope) const {
  PositionsInTable at;
  find_positions(size, columns_, std::log(least_s), least_log_A, side, log_A, s, at);
  interpolate_all(size, patches_.data(), at);
  add_to_asinh(size, std::exp(least_log_A), side, A, s, at, mean, slope);
}

namespace {

constexpr std::size_t lanes = 8;

/// Mean over slip of asinh(A r), from ln A, to 1e-11.
double mean_of_asinh(double log_A, double s) {
  constexpr double log_two = 0.69314718055994531, large = 18;  // asinh(e^x) is x + ln 2 above it
  constexpr TailSum smooth{.step = 0.32, .end = 28.5};
  return mean_over_train(s, Closure::consistent, smooth, [log_A](double r) {
    const double log_x = log_A + std::log(r);
    return log_x > large ? log_x + log_two : std::asinh(std::exp(log_x));
  });
}

constexpr double logarithmic_from = 16;  ///< A s; AsinhMeanTable::largest_As is more

/// A of trains, where a asinh(A) is the force at the largest slip velocity, and the way to find the mean of asinh(A r)
/// over slip.
struct Amplitudes {
  double log_A[PhaseNodes::most], A[PhaseNodes::most];                ///< A between e^-650 and e^300
  double logarithmic[PhaseNodes::most], tabulated[PhaseNodes::most];  ///< 1 or 0
  std::size_t count_logarithmic = 0, count_tabulated = 0;
};

SLIPFRONT_CLONES void find_amplitudes(const AsinhForce& law, std::size_t size, const double* fastest, const double* s,
                                      const double* theta, Amplitudes& at) {
  const AsinhForce r = law;
  SLIPFRONT_INDEPENDENT
  for (std::size_t i = 0; i < size; ++i) at.log_A[i] = r.exponent_branch_free(theta[i]);
  SLIPFRONT_INDEPENDENT
  for (std::size_t i = 0; i < size; ++i) at.log_A[i] += log_branch_free(at_least(fastest[i], 1e-300));
  std::size_t logarithmic = 0, tabulated = 0;
  SLIPFRONT_INDEPENDENT
  for (std::size_t i = 0; i < size; ++i) {
    const double A = exp_branch_free(at_least(at_most(at.log_A[i], 300.0), -650.0));
    const bool large = A * s[i] >= logarithmic_from;
    const bool in_table = !large & (s[i] >= AsinhMeanTable::least_s) & (s[i] <= AsinhMeanTable::largest_s);
    at.A[i] = A;
    at.logarithmic[i] = large ? 1.0 : 0.0;
    at.tabulated[i] = in_table ? 1.0 : 0.0;
    logarithmic += large ? 1u : 0u;
    tabulated += in_table ? 1u : 0u;
  }
  at.count_logarithmic = logarithmic;
  at.count_tabulated = tabulated;
}

/// The mean of asinh(A r) over slip where A s is large: ln A + ln(1 + s), as <ln r> = ln((1 + s) / 2), and the next
/// terms of asinh(x) = ln 2x + 1 / 4 x^2 - 3 / 32 x^4 + 5 / 96 x^6, with <r^-2> = 1 / s and so on.
SLIPFRONT_CLONES void logarithmic_means(double a, std::size_t size, const Amplitudes& amplitudes, const double* s,
                                        double* mean, double* slope) {
  SLIPFRONT_INDEPENDENT
  for (std::size_t i = 0; i < size; ++i) {
    const double at = s[i], s2 = at * at, p = at * amplitudes.A[i], q = 1 / at_least(p * p, 1.0);
    const double c4 = 3.0 / 64 * (1 + s2), c6 = 5.0 / 768 * (3 + 2 * s2 + 3 * s2 * s2);
    mean[i] = a * (amplitudes.log_A[i] + log_branch_free(1 + at) + at * q * (0.25 - q * (c4 - q * c6)));
    slope[i] = a * (1 - at * q * (0.5 - q * (4 * c4 - q * 6 * c6)));
  }
}

SLIPFRONT_CLONES void add_asinh(std::size_t size, const double* A, const double* r, const double* weight, double* sum,
                                double* slopes, double* weights) {
  SLIPFRONT_INDEPENDENT
  for (std::size_t i = 0; i < size; ++i) {
    const double x = A[i] * r[i], root = std::sqrt(1 + x * x);
    const LogRatio asinh = asinh_ratio(x, root);
    const double inverse = 1 / (asinh.below * root);  // one division, not two
    sum[i] += weight[i] * (2 * asinh.half_log(root * inverse));
    slopes[i] += weight[i] * (x * asinh.below * inverse);
    weights[i] += weight[i];
  }
}

/// Means where A s is not large, in a table.
void means_by_table(double a, std::size_t size, const double* log_A, const double* A, const double* s, double* mean,
                    double* slope) {
  AsinhMeanTable::get().look_up(size, log_A, A, s, mean, slope);
  for (std::size_t i = 0; i < size; ++i) {
    mean[i] *= a;
    slope[i] *= a;
  }
}

/// Means by quadrature where A is not large, of at most PhaseNodes::most trains of one kind.
void means_by_quadrature(double a, std::size_t size, const double*, const double* A, const double* s, double* mean,
                         double* slope) {
  constexpr std::size_t most = PhaseNodes::most;
  double r[most], weight[most], weights[most] = {};
  const PhaseNodes nodes(size, s);
  std::fill_n(mean, size, 0.0);
  std::fill_n(slope, size, 0.0);
  for (std::size_t k = 0; k < nodes.count(); ++k) {
    nodes.node(k, Closure::consistent, r, weight);
    add_asinh(size, A, r, weight, mean, slope, weights);
  }
  for (std::size_t i = 0; i < size; ++i) {
    mean[i] *= a / weights[i];
    slope[i] *= a / weights[i];
  }
}

/// Some of at most PhaseNodes::most trains, whose means are found together.
struct Some {
  std::size_t count = 0;
  std::size_t index[PhaseNodes::most];
  double log_A[PhaseNodes::most], A[PhaseNodes::most], s[PhaseNodes::most];

  void add(std::size_t i, double log_A_there, double A_there, double s_there) {
    index[count] = i;
    log_A[count] = log_A_there;
    A[count] = A_there;
    s[count++] = s_there;
  }
  template <class Means>
  void find(const Means& means, double a, double* mean, double* slope) {
    if (count == 0) return;
    while (count % lanes != 0) add(index[count - 1], log_A[count - 1], A[count - 1], s[count - 1]);  // whole vectors
    double some_mean[PhaseNodes::most], some_slope[PhaseNodes::most];
    means(a, count, log_A, A, s, some_mean, some_slope);
    for (std::size_t i = 0; i < count; ++i) {
      mean[index[i]] = some_mean[i];
      slope[index[i]] = some_slope[i];
    }
  }
};

}  // namespace

/// Over slip, <ln w> = ln(a sinh |phi|) + psi: (1 / 2 pi) int ln(cosh 2 psi - cos u) du = 2 psi - ln 2. So the average
/// of the law is the law itself at the speed a sinh |phi| e^psi, except where f is no logarithm, near rest.
double AsinhAverage::mean_strength(const State& train, double contact, Closure closure, LocalState theta) const {
  if (train.phi == 0 || train.empty()) return 0;
  if (closure != Closure::consistent) return QuadratureAverage::mean_strength(train, contact, closure, theta);
  constexpr double large = 18;
  const double log_sinh = std::log(2 * contact * std::sinh(std::fabs(train.phi))) + force_.exponent(theta[0]);
  if (log_sinh + std::log(2 * std::sinh(train.psi)) > large) return force_.a * (log_sinh + train.psi);
  return force_.a * mean_of_asinh(log_sinh + std::log(std::cosh(train.psi)), std::tanh(train.psi));
}

void AsinhAverage::mean_strengths(const Trains& trains, Closure closure, double* mean, double* slope) const {
  if (closure != Closure::consistent) return QuadratureAverage::mean_strengths(trains, closure, mean, slope);
  constexpr std::size_t most = PhaseNodes::most;
  const double a = force_.a;
  Amplitudes at;
  double slopes[most], copies[most];
  for (std::size_t begin = 0; begin < trains.size; begin += most) {
    const std::size_t n = std::min(most, trains.size - begin);
    const double* const s = trains.s + begin;
    find_amplitudes(force_, n, trains.fastest + begin, s, trains.states.from(begin).column(0, n, copies), at);
    if (at.count_tabulated == n) {
      means_by_table(a, n, at.log_A, at.A, s, mean + begin, slopes);
    } else {
      if (at.count_logarithmic > 0) logarithmic_means(a, n, at, s, mean + begin, slopes);
      Some tabulated;
      std::array<Some, PhaseNodes::kinds> others;
      for (std::size_t i = 0; i < n && at.count_logarithmic < n; ++i)
        if (at.logarithmic[i] == 0)
          (at.tabulated[i] != 0 ? tabulated : others[PhaseNodes::kind_of(s[i])]).add(i, at.log_A[i], at.A[i], s[i]);
      tabulated.find(means_by_table, a, mean + begin, slopes);
      for (Some& some : others) some.find(means_by_quadrature, a, mean + begin, slopes);
    }
    if (slope != nullptr) std::copy_n(slopes, n, slope + begin);
  }
}

}  // namespace slipfront::friction
