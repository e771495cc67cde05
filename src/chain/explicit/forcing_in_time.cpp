#include "chain/explicit/forcing_in_time.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "chain/explicit/levels/kernel.hpp"
#include "slipfront/error.hpp"

namespace slipfront::chain {
namespace {

constexpr double tolerance = 1e-13, infinity = std::numeric_limits<double>::infinity();

/// Chebyshev's node i of n on [-1, 1].
double node(std::size_t i, std::size_t n) {
  return std::cos(std::numbers::pi * (static_cast<double>(i) + 0.5) / static_cast<double>(n));
}

}  // namespace

void ForcingInTime::at(long level, const Ranks& ranks, std::vector<double>& F) {
  if (level < begin_ || level >= end_) choose(level, ranks);
  if (!polynomial_) {
    for (std::size_t j = 0; j < F.size(); ++j) F[j] = formula(j, static_cast<double>(level));
    return;
  }
  const auto weight = weights(static_cast<double>(level));
  std::array<const double*, nodes> values;
  for (std::size_t i = 0; i < nodes; ++i) values[i] = values_[i].data();
  weighted_sum(weight, values, F.data(), F.size());
}

/// The weights of the values at the nodes in the value at a level, by the barycentric formula.
std::array<double, ForcingInTime::nodes> ForcingInTime::weights(double level) const {
  const double middle = 0.5 * static_cast<double>(begin_ + end_), half = 0.5 * static_cast<double>(end_ - begin_);
  const double s = (level - middle) / half;
  std::array<double, nodes> weight{};
  double sum = 0;
  for (std::size_t i = 0; i < nodes; ++i) {
    const double away = s - node(i, nodes);
    if (away == 0) {
      weight.fill(0);
      weight[i] = 1;
      return weight;
    }
    const double angle = std::numbers::pi * (static_cast<double>(i) + 0.5) / static_cast<double>(nodes);
    weight[i] = (i % 2 == 0 ? 1 : -1) * std::sin(angle) / away;
    sum += weight[i];
  }
  for (double& w : weight) w /= sum;
  return weight;
}

/// Takes the longest polynomial that is right. Its levels begin at a multiple of their number, whatever came before.
void ForcingInTime::choose(long level, const Ranks& ranks) {
  for (long levels = longest; levels >= shortest; levels /= 2) {
    begin_ = level / levels * levels;
    end_ = begin_ + levels;
    polynomial_ = fits(ranks);
    if (polynomial_) return;
  }
}

void ForcingInTime::fill(std::size_t stride) {
  const double middle = 0.5 * static_cast<double>(begin_ + end_), half = 0.5 * static_cast<double>(end_ - begin_);
  for (std::size_t i = 0; i < nodes; ++i) {
    values_[i].resize(x_.size());
    for (std::size_t j = 0; j < x_.size(); j += stride) {
      values_[i][j] = formula(j, middle + half * node(i, nodes));
      most_ = std::fmax(most_, std::fabs(values_[i][j]));
    }
  }
}

/// The largest difference from the formula at a level, at every 64th site from `first` on.
double ForcingInTime::largest_error(long level, std::size_t first) const {
  const auto weight = weights(static_cast<double>(level));
  double most = 0;
  for (std::size_t j = first; j < x_.size(); j += apart) {
    double sum = 0;
    for (std::size_t i = 0; i < nodes; ++i) sum += weight[i] * values_[i][j];
    const double error = std::fabs(sum - formula(j, static_cast<double>(level)));
    if (std::isnan(error)) return infinity;
    most = std::fmax(most, error);
  }
  return most;
}

bool ForcingInTime::fits(const Ranks& ranks) {
  const auto most_of_all = [&](double mine) {
    if (ranks.size() == 1) return mine;
    double most = 0;
    for (const double theirs : ranks.joined({mine})) most = std::fmax(most, theirs);
    return most;
  };
  // A formula need not have values after the end of a run.
  const auto error_of = [](const auto& measure) {
    try {
      return measure();
    } catch (const InputError&) {
      return infinity;
    }
  };
  most_ = 0;
  const double at_first_sites = error_of([&] {  // a few calls refuse most polynomials that are too long
    fill(apart);
    return largest_error(begin_ + 1, 0);
  });
  most_ = most_of_all(most_);
  if (most_of_all(at_first_sites) > tolerance * most_) return false;
  const double at_nodes = error_of([&] {
    fill(1);
    return 0.0;
  });
  most_ = most_of_all(most_);
  const double error = error_of([&] {
    double most = at_nodes;
    for (long level = begin_; level < end_ && most <= tolerance * most_; ++level)
      most = std::fmax(most, largest_error(level, static_cast<std::size_t>(level) * 29 % apart));
    return most;
  });
  return most_of_all(error) <= tolerance * most_;
}

}  // namespace slipfront::chain
