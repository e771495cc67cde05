#include "observed.hpp"

#include <algorithm>
#include <array>
#include <boost/math/quadrature/gauss_kronrod.hpp>
#include <boost/math/tools/minima.hpp>
#include <cmath>
#include <cstddef>

#include "math/roots.hpp"
#include "slipfront/theory/rupture/relations.hpp"
#include "slipfront/theory/rupture/riemann.hpp"

namespace slipfront::friction_ratio {
namespace {

/// Cells at the trailing edge in which the solver smears the corner of W.
constexpr std::size_t smeared = 6;

/// x at which an increasing function reaches a value.
template <class Function>
double where(const Function& increasing, double value, double low, double high) {
  return bisected({.holding = low, .failing = high}, [&](double x) { return increasing(x) < value; }).failing;
}

/// Distance from the trailing edge x = edge at which W = `wanted`, in the cells where the solver smears the corner. W
/// is 0 at the edge, so W / distance is smooth. We extrapolate its logarithm from three points further inside.
double distance_in_smeared_cells(const Point* first, double edge, double wanted) {
  std::array<double, 3> d{}, g{};
  for (std::size_t i = 0; i < 3; ++i) {
    const Point& p = first[2 * smeared * i];
    d[i] = p.x - edge, g[i] = std::log(p.W / d[i]);
  }
  const double slope = (g[1] - g[0]) / (d[1] - d[0]);
  const double curve = ((g[2] - g[1]) / (d[2] - d[1]) - slope) / (d[2] - d[0]);
  const auto W = [&](double x) { return x * std::exp(g[0] + (x - d[0]) * (slope + (x - d[1]) * curve)); };
  return where(W, wanted, 0, d[0]);
}

/// W at x / t in the frictionless pulse, and the largest W uphill from x = 0.
struct Fan {
  explicit Fan(double stress) : pulse(rupture::slip_pulse(stress)) {
    const double V = -pulse.left_wave.outer, end = pulse.left_wave.inner, step = 1e-3 * V;
    double top = 0;
    while (top - step > -V && W(top - step) > W(top)) top -= step;
    while (top + step < end && W(top + step) > W(top)) top += step;
    const auto found = boost::math::tools::brent_find_minima([this](double x) { return -W(x); },
                                                             std::fmax(top - step, -V), std::fmin(top + step, end), 40);
    top_at = found.first, peak = -found.second;
  }
  double W(double x_over_t) const { return rupture::profile_point(pulse, x_over_t).W; }
  rupture::RiemannSolution pulse;
  double top_at = 0, peak = 0;
};

}  // namespace

double observed_front(const Pulse& pulse, double stress, double threshold) {
  const double V = rupture::from_stress(stress).rupture_velocity, wanted = threshold * peak_of(pulse.points);
  const auto& points = pulse.points;
  // Points are face, centre, face ..., so that a cell has two.
  const auto moving = std::find_if(points.begin(), points.end(), [V](const Point& p) { return p.x > -V; });
  const bool has_edge = moving != points.begin();  // else the cells begin where W is far below the threshold
  const auto resolved = has_edge ? moving + 2 * smeared : moving + 1;
  if (has_edge && resolved->W >= wanted) return 1 - distance_in_smeared_cells(&*resolved, -V, wanted) / V;
  const auto above = std::find_if(resolved, points.end(), [&](const Point& p) { return p.W >= wanted; });
  const Point &a = above[-1], &b = *above;
  return -(a.x + (b.x - a.x) * std::log(wanted / a.W) / std::log(b.W / a.W)) / V;
}

double frictionless_front(double stress, double threshold) {
  const Fan fan(stress);
  const double V = -fan.pulse.left_wave.outer;
  // In x / V from the edge, so that a small distance has all digits.
  return 1 - where([&](double d) { return fan.W((d - 1) * V); }, threshold * fan.peak, 0, 1 + fan.top_at / V);
}

DropShares observed_drops(const Pulse& pulse, double stress) {
  double area = 0;
  Point last = pulse.points.front();
  for (const Point& p : pulse.points) {
    const Point next = p.x < 0 ? p : Point{0, 0, pulse.slip_at_origin};
    area += (last.slip + next.slip) / 2 * (next.x - last.x);
    if (p.x >= 0) break;
    last = next;
  }
  // The drop is the slope of slip, so its integral with slip as weight is half the square of slip at x = 0.
  return {1 - pulse.stress_at_origin / stress, std::pow(pulse.slip_at_origin, 2) / (2 * area * stress)};
}

DropShares frictionless_drops(double stress) {
  using Rule = boost::math::quadrature::gauss_kronrod<double, 31>;
  const rupture::Relations r = rupture::from_stress(stress);
  const Fan fan(stress);
  const double V = r.rupture_velocity;
  const auto drop = [&](double d) { return stress - rupture::profile_point(fan.pulse, (d - 1) * V).Sigma; };
  // Slip at x is the integral of the drop from -V to x. Its integral over x < 0 is a single one, by parts.
  const double slip = V * Rule::integrate(drop, 0.0, 1.0, 12, 1e-10);
  const double area = V * V * Rule::integrate([&](double d) { return (1 - d) * drop(d); }, 0.0, 1.0, 12, 1e-10);
  return {1 - r.stress_at_origin / stress, slip * slip / (2 * area * stress)};
}

}  // namespace slipfront::friction_ratio
