#include "friction/train_means/asinh_mean_table.hpp"

#include <algorithm>

#include "foundation/simd/elementary.hpp"
#include "foundation/simd/vector_code.hpp"
#include "friction/train_means/phase_nodes.hpp"

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

}  // namespace slipfront::friction
