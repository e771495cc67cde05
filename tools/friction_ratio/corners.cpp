#include "corners.hpp"

#include <cmath>
#include <cstddef>
#include <vector>

#include "nodes.hpp"
#include "slipfront/friction/ratio/table.hpp"
#include "solve.hpp"

namespace slipfront::friction_ratio {

namespace {

/// The index, on an even grid of ln(1 + Gamma), at which the second derivative of `y` has its largest upward jump.
std::size_t sharpest(const std::vector<double>& y) {
  std::size_t at = 0;
  double jump = 0;
  for (std::size_t n = 8; n + 8 < y.size(); ++n) {
    const double found = y[n + 2] - 2 * y[n + 1] + 2 * y[n - 1] - y[n - 2];
    if (found > jump) jump = found, at = n;
  }
  return at;
}

/// The position, counted from `from`, at which the parabola through y[from - 4], y[from - 2] and y[from] meets that
/// through y[to], y[to + 2] and y[to + 4].
double meeting(const std::vector<double>& y, std::size_t from, std::size_t to) {
  const auto parabola = [&](const double* v, std::ptrdiff_t direction,
                            double x) {  // v[0], v[2 direction], v[4 direction]
    const double a = v[0], b = v[2 * direction], c = v[4 * direction];
    const double s = x / 2;
    return a + s * (b - a) + s * (s - 1) / 2 * (c - 2 * b + a);
  };
  const double width = static_cast<double>(to - from);
  double low = 0, high = width;
  const auto above = [&](double x) { return parabola(&y[from], -1, -x) > parabola(&y[to], 1, x - width); };
  const bool left_above = above(low);
  for (int n = 0; n < 40; ++n) (above((low + high) / 2) == left_above ? low : high) = (low + high) / 2;
  return low;
}

/// ln(1 + Gamma) at the corners of the table. The slope of ln W(0) changes at the first. At the second, another maximum
/// of W(x) becomes the peak.
struct CornersAt {
  double origin, peak;
};
CornersAt corners_at(double stress) {
  constexpr double step = 0.004, first = 0.15;
  constexpr int count = 338;  // up to 1.498
  std::vector<double> dampings, origin, peak;
  for (int n = 0; n < count; ++n) dampings.push_back(std::expm1(first + step * n));
  for (const SlipVelocities& w : solve_each(stress, friction::Closure::consistent, 3200, dampings)) {
    origin.push_back(std::log(w.origin));
    peak.push_back(std::log(w.peak));
  }
  const std::size_t near_peak = sharpest(peak);
  return {first + step * static_cast<double>(sharpest(origin)),
          first + step * (static_cast<double>(near_peak - 2) + meeting(peak, near_peak - 2, near_peak + 2))};
}

}  // namespace

layout::Corners find_corners() {
  std::array<CornersAt, layout::y_nodes> found;
#pragma omp parallel for schedule(dynamic)
  for (std::size_t i = 0; i < layout::y_nodes; ++i) found[i] = corners_at(stress_node(i));
  layout::Corners result{};
  for (std::size_t i = 0; i < layout::corner_terms; ++i) {
    const auto term = [&](double CornersAt::*u) {
      return coefficient(i, layout::y_nodes, [&](std::size_t n) { return found[n].*u; });
    };
    result[0][static_cast<std::size_t>(SlipVelocityKind::origin)][i] = term(&CornersAt::origin);
    result[0][static_cast<std::size_t>(SlipVelocityKind::peak)][i] = term(&CornersAt::peak);
    // The slope of W(0) changes there, and with it the curvature of its mean in time.
    result[0][static_cast<std::size_t>(SlipVelocityKind::time_mean)][i] = term(&CornersAt::origin);
  }
  return result;
}

}  // namespace slipfront::friction_ratio
