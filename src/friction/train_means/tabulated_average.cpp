#include "friction/train_means/tabulated_average.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "friction/train_means/mean_over_train.hpp"
#include "math/simd/elementary.hpp"
#include "math/simd/vector_code.hpp"
#include "slipfront/error.hpp"

namespace slipfront::friction {
namespace {

constexpr std::size_t patch_terms = ChebyshevPatch::terms;
constexpr double side = 0.25;                             ///< size of a patch in ln(fastest) and in ln s
constexpr double first_row = -138.5, first_column = -14;  ///< logarithms at which the patches begin
constexpr std::size_t rows = 571, columns = 56;           ///< they end at ln(fastest) = 4.25 and s = 1
constexpr double slowest = 1e-60, fastest_of_all = 64, least_s = 1e-6,
                 largest_s = 0.9999999;  ///< limits, inside the patches
constexpr double precision = 2e-11;      ///< largest relative error of a mean

/// Positions of at most `most` trains in the table.
struct Positions {
  static constexpr std::size_t most = PhaseNodes::most;
  double row[most], column[most];  ///< -1 outside the table
  double x[most], y[most];         ///< -1 to 1 across the patch
  const ChebyshevPatch* patch[most];
  double mean[most], slope[most];
};

SLIPFRONT_CLONES void find_positions(std::size_t size, const double* fastest, const double* s, Positions& at) {
  constexpr double per_side = 1 / side;
  SLIPFRONT_INDEPENDENT
  for (std::size_t i = 0; i < size; ++i) {
    const bool inside = (fastest[i] > slowest) & (fastest[i] < fastest_of_all) & (s[i] > least_s) & (s[i] < largest_s);
    const double row = (log_branch_free(inside ? fastest[i] : 1.0) - first_row) * per_side;
    const double column = (log_branch_free(inside ? s[i] : 0.5) - first_column) * per_side;
    const int whole_row = static_cast<int>(row), whole_column = static_cast<int>(column);
    at.x[i] = 2 * (row - whole_row) - 1;
    at.y[i] = 2 * (column - whole_column) - 1;
    at.row[i] = inside ? whole_row : -1.0;
    at.column[i] = whole_column;
  }
}

/// Interpolates for one train after the other, because gathering coefficients for many trains would take longer.
SLIPFRONT_CLONES void interpolate_all(std::size_t size, Positions& at) {
  for (std::size_t i = 0; i < size; ++i) {
    const ValueAndSlope found = interpolate(*at.patch[i], at.x[i], at.y[i]);
    at.mean[i] = found.value;
    at.slope[i] = found.by_x * (2 / side);
  }
}

/// Computes the means of trains at `count` points of a patch. `node(i)` gives the coordinates of point i, from -1 to 1.
template <std::size_t count, class Node>
void means_at(const ForceLoops& loops, std::size_t row, std::size_t column, const Node& node, double* mean) {
  double fastest[count], s[count];
  for (std::size_t i = 0; i < count; ++i) {
    const auto [x, y] = node(i);
    fastest[i] = std::exp(first_row + (static_cast<double>(row) + (1 + x) / 2) * side);
    s[i] = std::fmin(std::exp(first_column + (static_cast<double>(column) + (1 + y) / 2) * side), 1.0);
  }
  means_by_phase(loops, {count, fastest, s, {}}, Closure::consistent, mean);
}

struct Node {
  double x, y;
};

}  // namespace

TabulatedAverage::Patch TabulatedAverage::made(std::size_t row, std::size_t column) const {
  using Fit = ChebyshevPatch::Fit;
  static const Fit through;
  Patch patch{};
  ChebyshevPatch::Values values;
  means_at<patch_terms * patch_terms>(
      law_.loops(), row, column,
      [](std::size_t i) {
        return Node{Fit::extremum(i / patch_terms), Fit::extremum(i % patch_terms)};
      },
      &values[0][0]);
  patch.polynomial.fit(through, values);
  // Check the polynomial between the nodes, along both diagonals.
  constexpr std::size_t between = 2 * (patch_terms - 1);
  const auto node = [](std::size_t i) {
    const std::size_t pair = i / 2;
    const double x = std::cos(std::numbers::pi * (static_cast<double>(pair) + 0.5) / (patch_terms - 1));
    return Node{x, i % 2 == 0 ? x : -x};
  };
  double mean[between];
  means_at<between>(law_.loops(), row, column, node, mean);
  patch.good = true;
  for (std::size_t i = 0; i < between; ++i) {
    const double found = interpolate(patch.polynomial, node(i).x, node(i).y).value;
    patch.good = patch.good && std::fabs(found - mean[i]) <= precision * std::fabs(mean[i]);
  }
  return patch;
}

const ChebyshevPatch* TabulatedAverage::good_patch(std::size_t row, std::size_t column) const {
  const auto if_good = [](const Patch* known) { return known->good ? &known->polynomial : nullptr; };
  std::atomic<const Patch*>& entry = patches_[row * columns + column];
  if (const Patch* known = entry.load(std::memory_order_acquire)) return if_good(known);
  Patch found{};
  try {
    found = made(row, column);
  } catch (const InputError&) {  // the curve ends; quadrature reports the speed if a train reaches it
    found.good = false;
  }
  const std::lock_guard<std::mutex> lock(making_);
  if (entry.load(std::memory_order_relaxed) == nullptr)
    entry.store(&all_.emplace_back(found), std::memory_order_release);
  return if_good(entry.load(std::memory_order_relaxed));
}

void TabulatedAverage::mean_strengths(const Trains& trains, Closure closure, double* mean, double* slope) const {
  if (closure != Closure::consistent) return QuadratureAverage::mean_strengths(trains, closure, mean, slope);
  static constexpr ChebyshevPatch none{};
  std::call_once(once_, [this] { patches_ = std::vector<std::atomic<const Patch*>>(rows * columns); });
  Positions at;
  thread_local std::vector<std::size_t> others;  // reused, so that steps allocate nothing
  others.clear();
  for (std::size_t begin = 0; begin < trains.size; begin += Positions::most) {
    const std::size_t some = std::min(Positions::most, trains.size - begin);
    find_positions(some, trains.fastest + begin, trains.s + begin, at);
    for (std::size_t i = 0; i < some; ++i) {
      at.patch[i] = at.row[i] < 0
                        ? nullptr
                        : good_patch(static_cast<std::size_t>(at.row[i]), static_cast<std::size_t>(at.column[i]));
      if (at.patch[i] != nullptr) continue;
      others.push_back(begin + i);
      at.patch[i] = &none;
    }
    interpolate_all(some, at);
    std::copy_n(at.mean, some, mean + begin);
    if (slope != nullptr) std::copy_n(at.slope, some, slope + begin);
  }
  if (others.empty()) return;
  thread_local std::vector<double> fastest, s, means, slopes;
  fastest.clear();
  s.clear();
  means.resize(others.size());
  slopes.resize(others.size());
  for (const std::size_t i : others) {
    fastest.push_back(trains.fastest[i]);
    s.push_back(trains.s[i]);
  }
  QuadratureAverage::mean_strengths({others.size(), fastest.data(), s.data(), {}}, Closure::consistent, means.data(),
                                    slope == nullptr ? nullptr : slopes.data());
  for (std::size_t i = 0; i < others.size(); ++i) {
    mean[others[i]] = means[i];
    if (slope != nullptr) slope[others[i]] = slopes[i];
  }
}

}  // namespace slipfront::friction
