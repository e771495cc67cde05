#include "layout.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>

#include "slipfront/error.hpp"

namespace slipfront::pulse {
namespace {

using std::numbers::pi;

/// Boundary of the stressed stretch between an empty point and a stressed one, by bisection.
double edge_between(const std::function<double(double)>& stress, double empty, double stressed) {
  for (int i = 0; i < 200; ++i) {
    const double middle = empty + (stressed - empty) / 2;
    if (middle == empty || middle == stressed) break;
    (stress(middle) > 0 ? stressed : empty) = middle;
  }
  return stressed;
}

/// Ten-point Gauss rule: exact to rounding for smooth stress in one cell.
double integral(const std::function<double(double)>& f, double a, double b) {
  constexpr double node[5] = {0.1488743389816312, 0.4333953941292472, 0.6794095682990244, 0.8650633666889845,
                              0.9739065285171717};
  constexpr double weight[5] = {0.2955242247147529, 0.2692667193099964, 0.2190863625159820, 0.1494513491505806,
                                0.0666713443086881};
  const double middle = a + (b - a) / 2, half = (b - a) / 2;
  double sum = 0;
  for (int i = 0; i < 5; ++i) sum += weight[i] * (f(middle - half * node[i]) + f(middle + half * node[i]));
  return sum * half;
}

/// From 0 to 1, with vanishing slope at the free ends.
double graded(double s, bool left_free, bool right_free) {
  if (left_free && right_free) return s * s * (3 - 2 * s);
  if (left_free) return s * s;
  if (right_free) return 1 - (1 - s) * (1 - s);
  return s;
}

/// Where cells should be small: 1 far from everything, more where the stress changes. Its integral, as a share of the
/// whole, is the coordinate in which cells are even.
class Monitor {
 public:
  static constexpr int samples = 4096;

  /// From the stress at samples + 1 points.
  Monitor(const std::vector<double>& value, double from, double to, double corner)
      : from_(from), h_((to - from) / samples) {
    std::vector<double> density(samples + 1, 1.0);
    const auto [low, high] = std::minmax_element(value.begin(), value.end());
    const double range = *high - *low;
    const bool stepped = corner > from && corner < to;
    for (int i = 1; i < samples && range > 0 && !stepped; ++i) {
      // sqrt(1 + slope^2), levelling off: smooth where the stress is.
      const double slope = pull * samples * (value[at(i + 1)] - value[at(i - 1)]) / (2 * range);
      density[at(i)] = std::sqrt(1 + slope * slope / (1 + slope * slope / (most * most)));
    }
    for (int pass = 0; pass < 3; ++pass) smooth(density);
    if (stepped)
      for (int i = 0; i <= samples; ++i)
        density[at(i)] += 3 / (1 + std::pow((from + i * h_ - corner) / (0.08 * (to - from)), 2));
    integral_.assign(samples + 1, 0.0);
    for (int i = 1; i <= samples; ++i)
      integral_[at(i)] = integral_[at(i - 1)] + (density[at(i - 1)] + density[at(i)]) / 2;
    density_ = std::move(density);
  }

  /// x at a share of the integral: cubic Hermite in it, so that neighbouring cells change smoothly.
  double x_at(double share) const {
    const double target = share * integral_.back();
    const auto above = std::upper_bound(integral_.begin() + 1, integral_.end() - 1, target);
    const std::size_t i = static_cast<std::size_t>(above - integral_.begin()) - 1;
    const double width = integral_[i + 1] - integral_[i], s = (target - integral_[i]) / width, r = 1 - s;
    const double rise = s * s * (3 - 2 * s) + width * s * r * (r / density_[i] - s / density_[i + 1]);
    return from_ + (static_cast<double>(i) + rise) * h_;
  }
  double share_at(double x) const {
    const double position = (x - from_) / h_;
    const std::size_t i = std::min<std::size_t>(static_cast<std::size_t>(position), samples - 1);
    const double s = position - static_cast<double>(i);
    return (integral_[i] + s * (density_[i] + s * (density_[i + 1] - density_[i]) / 2)) / integral_.back();
  }

 private:
  // These and the smoothing were chosen by the error of W(0) with 60 to 120 cells, tanh profiles of width 0.1 to 2,
  // C = 0 to 2, both closures.
  static constexpr double most = 32;  ///< finest cells, times finer than the coarsest (before smoothing)
  static constexpr double pull = 3;   ///< of slopes; 1: cells even along the curve of stress over x, both scaled to 1

  static std::size_t at(int i) { return static_cast<std::size_t>(i); }
  /// Mean over 12 % of the stretch: neighbouring cells must differ little for the scheme to keep its order.
  static void smooth(std::vector<double>& f) {
    constexpr int half = 3 * samples / 50;
    std::vector<double> sum(f.size() + 1, 0.0);
    for (std::size_t i = 0; i < f.size(); ++i) sum[i + 1] = sum[i] + f[i];
    for (int i = 0; i <= samples; ++i) {
      const int low = std::max(0, i - half), high = std::min(samples, i + half);
      f[at(i)] = (sum[at(high) + 1] - sum[at(low)]) / (high - low + 1);
    }
  }

  double from_, h_;
  std::vector<double> integral_, density_;
};

/// Faces from `from` to `to`, even in the monitor's coordinate but graded towards free ends.
void fill(std::vector<double>& faces, const Monitor& monitor, double from, double to, int cells, bool left_free,
          bool right_free) {
  const double a = monitor.share_at(from), b = monitor.share_at(to);
  for (int i = 1; i <= cells; ++i)
    faces.push_back(
        i == cells ? to : monitor.x_at(a + (b - a) * graded(static_cast<double>(i) / cells, left_free, right_free)));
}

}  // namespace

Layout lay_cells(const std::function<double(double)>& stress, double left, double right, int cells, double corner) {
  constexpr int samples = Monitor::samples;
  const auto sample = [](int i, double a, double b) { return i == samples ? b : a + i * ((b - a) / samples); };
  const auto values = [&](double a, double b) {
    std::vector<double> value(samples + 1);
    for (int i = 0; i <= samples; ++i) value[static_cast<std::size_t>(i)] = stress(sample(i, a, b));
    return value;
  };
  const std::vector<double> value = values(left, right);
  const auto x = [&](int i) { return sample(i, left, right); };
  int first = -1, last = -1;
  for (int i = 0; i <= samples; ++i) {
    if (!(value[static_cast<std::size_t>(i)] > 0)) continue;
    if (first < 0) first = i;
    if (last >= 0 && i > last + 1)
      throw InputError(
          {.key = "initial",
           .problem = "no stress between x = " + std::to_string(x(last)) + " and x = " + std::to_string(x(i)),
           .allowed = "one stressed stretch, with empty interface on its left or right only"});
    last = i;
  }
  if (first < 0)
    throw InputError(
        {.key = "initial", .problem = "no stress anywhere in the domain", .allowed = "stress > 0 somewhere"});
  Layout layout{{}, {}, first > 0, last < samples};
  const double from = layout.left_free ? edge_between(stress, x(first - 1), x(first)) : left;
  const double to = layout.right_free ? edge_between(stress, x(last + 1), x(last)) : right;
  const Monitor monitor(from == left && to == right ? value : values(from, to), from, to, corner);
  layout.faces.push_back(from);
  if (corner > from && corner < to) {
    const int before = std::clamp(static_cast<int>(std::lround(cells * monitor.share_at(corner))), 1, cells - 1);
    fill(layout.faces, monitor, from, corner, before, layout.left_free, false);
    fill(layout.faces, monitor, corner, to, cells - before, false, layout.right_free);
  } else {
    fill(layout.faces, monitor, from, to, cells, layout.left_free, layout.right_free);
  }
  for (std::size_t i = 0; i + 1 < layout.faces.size(); ++i)
    layout.charge.push_back(integral(stress, layout.faces[i], layout.faces[i + 1]) / (2 * pi));
  return layout;
}

}  // namespace slipfront::pulse
