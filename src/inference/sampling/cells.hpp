#pragma once
/// \file
/// A proposal density in three dimensions that is constant in each of some cells.

#include <cstddef>
#include <vector>

#include "slipfront/catalogue/measured.hpp"

namespace slipfront::inference {

/// Cells along one coordinate. A coordinate that is known exactly has one cell of no width.
struct Axis {
  std::vector<double> edges;

  static Axis exact(double x) { return {{x}}; }
  static Axis uniform(double low, double high, std::size_t cells);

  bool is_exact() const { return edges.size() == 1; }
  std::size_t cells() const { return is_exact() ? 1 : edges.size() - 1; }
  double centre(std::size_t i) const { return is_exact() ? edges[0] : (edges[i] + edges[i + 1]) / 2; }
  /// Width of a cell; 1 if the coordinate is exact.
  double width(std::size_t i) const { return is_exact() ? 1 : edges[i + 1] - edges[i]; }
};

/// Cells in ln x for a measured quantity x with low <= x <= high. They are narrow where its likelihood changes, and
/// reach six standard deviations. A normal error has further cells down to `low`, because its likelihood does not
/// vanish there. There are no cells if the likelihood vanishes between `low` and `high`.
enum class Fineness { coarse, fine };
Axis axis_of(const catalogue::Measured& measured, double low, double high, Fineness fineness);

/// The density on the cells of three axes.
class Cells {
 public:
  Cells(Axis first, Axis second, Axis third);

  const Axis& axis(std::size_t i) const { return axes_[i]; }
  /// The value of the target density in a cell, at its middle.
  double& target(std::size_t i, std::size_t j, std::size_t k) {
    return share_[(i * axes_[1].cells() + j) * axes_[2].cells() + k];
  }
  /// New edges of an axis, such that its cells have similar shares of the target.
  Axis refined(std::size_t axis, std::size_t cells) const;
  /// Turns the target into a proposal density. Every cell keeps a part of `defence` (which must be below 1), shared out
  /// by `first_base` and `third_base`, the densities of these coordinates. The target must not vanish everywhere.
  void finish(double defence, const std::vector<double>& first_base, const std::vector<double>& third_base);

  struct Point {
    double first, second, third;
    double density;
  };
  /// The point for three uniformly distributed numbers between 0 and 1.
  Point at(double p, double q, double r) const;

 private:
  Axis axes_[3];
  std::vector<double> share_;                   ///< the target, then the share of each cell
  std::vector<double> first_, second_, third_;  ///< cumulative shares; the second and third within those before
};

}  // namespace slipfront::inference
