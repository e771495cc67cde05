#pragma once

#include <utility>
#include <vector>

namespace slipfront::scenario {

/// A smooth curve through points (x strictly increasing, at least two) that never leaves the range of the two points
/// around x: stress interpolated with it is never negative.
class MonotoneCurve {
 public:
  explicit MonotoneCurve(std::vector<std::pair<double, double>> points);
  double first() const { return points_.front().first; }
  double last() const { return points_.back().first; }
  double operator()(double x) const;  ///< first() <= x <= last()

 private:
  std::vector<std::pair<double, double>> points_;
  std::vector<double> slopes_;
};

}  // namespace slipfront::scenario
