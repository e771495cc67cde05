#include "scenario/profile/monotone.hpp"

#include <algorithm>
#include <cmath>

namespace slipfront::scenario {
namespace {

/// Slope at an inner point. It is 0 at an extremum, and otherwise the weighted harmonic mean of the chords before and
/// after (Fritsch & Butland 1984). This mean is in the region of Fritsch & Carlson (1980), where the cubic is monotone.
double inner_slope(double width, double next_width, double chord, double next_chord) {
  if (!(chord * next_chord > 0)) return 0;
  const double weight = 2 * next_width + width;
  const double next_weight = next_width + 2 * width;
  return (weight + next_weight) / (weight / chord + next_weight / next_chord);
}

/// Slope at an end: the slope of the parabola through three points, limited to the same region.
double end_slope(double width, double next_width, double chord, double next_chord) {
  const double slope = ((2 * width + next_width) * chord - width * next_chord) / (width + next_width);
  if (!(slope * chord > 0)) return 0;
  if (chord * next_chord <= 0 && std::fabs(slope) > 3 * std::fabs(chord)) return 3 * chord;
  return slope;
}

}  // namespace

MonotoneCurve::MonotoneCurve(std::vector<std::pair<double, double>> points) : points_(std::move(points)) {
  const std::size_t n = points_.size();
  std::vector<double> widths(n - 1);
  std::vector<double> chords(n - 1);
  for (std::size_t i = 0; i + 1 < n; ++i) {
    widths[i] = points_[i + 1].first - points_[i].first;
    chords[i] = (points_[i + 1].second - points_[i].second) / widths[i];
  }
  slopes_.assign(n, chords[0]);
  if (n == 2) return;
  slopes_.front() = end_slope(widths[0], widths[1], chords[0], chords[1]);
  slopes_.back() = end_slope(widths[n - 2], widths[n - 3], chords[n - 2], chords[n - 3]);
  for (std::size_t i = 1; i + 1 < n; ++i) slopes_[i] = inner_slope(widths[i - 1], widths[i], chords[i - 1], chords[i]);
}

double MonotoneCurve::operator()(double x) const {
  const auto after = std::upper_bound(points_.begin() + 1, points_.end() - 1, x,
                                      [](double value, const auto& point) { return value < point.first; });
  const std::size_t i = static_cast<std::size_t>(after - points_.begin()) - 1;
  const auto& [x0, y0] = points_[i];
  const auto& [x1, y1] = points_[i + 1];
  const double h = x1 - x0;
  const double s = (x - x0) / h;
  const double r = 1 - s;
  const double y =
      r * r * ((1 + 2 * s) * y0 + s * h * slopes_[i]) + s * s * ((1 + 2 * r) * y1 - r * h * slopes_[i + 1]);
  return std::clamp(y, std::min(y0, y1), std::max(y0, y1));  // rounding errors can leave the range
}

}  // namespace slipfront::scenario
