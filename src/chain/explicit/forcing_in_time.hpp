#pragma once

#include <array>
#include <cstddef>
#include <functional>
#include <utility>
#include <vector>

#include "foundation/ranks.hpp"

namespace slipfront::chain {

/// A forcing F(x, t) at the sites of a rank, level by level. A formula takes a hundred times as long as a site, so
/// where F is smooth in time it is the polynomial through its values at a few times, over as many levels as that is
/// right to 1e-13 of its largest value. Each of these levels is compared with the formula at every 64th site, at others
/// at the next level. Where no polynomial is right, the formula is called at each level.
class ForcingInTime {
 public:
  ForcingInTime() = default;
  /// `x` are the positions of the sites.
  ForcingInTime(std::function<double(double x, double t)> forcing, std::vector<double> x, double dt)
      : forcing_(std::move(forcing)), x_(std::move(x)), dt_(dt) {}

  /// (all) Sets F to its values at a level >= 0. They do not depend on the levels that were asked for before.
  void at(long level, const Ranks& ranks, std::vector<double>& F);

 private:
  static constexpr std::size_t nodes = 8;
  static constexpr long longest = 1024, shortest = 64;  ///< levels of a polynomial
  static constexpr std::size_t apart = 64;              ///< sites between those that are compared

  double formula(std::size_t site, double level) const { return forcing_(x_[site], level * dt_); }
  std::array<double, nodes> weights(double level) const;
  void choose(long level, const Ranks& ranks);
  /// (all) Whether the polynomial over the levels from begin_ to end_ is right.
  bool fits(const Ranks& ranks);
  double largest_error(long level, std::size_t first) const;
  void fill(std::size_t stride);

  std::function<double(double, double)> forcing_;
  std::vector<double> x_;
  double dt_ = 0;
  long begin_ = 0, end_ = 0;  ///< levels of the present polynomial, or of the present calls of the formula
  bool polynomial_ = false;
  double most_ = 0;  ///< largest |F| at the nodes, of all ranks
  std::array<std::vector<double>, nodes> values_;
};

}  // namespace slipfront::chain
