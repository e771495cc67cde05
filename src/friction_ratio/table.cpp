#include "slipfront/friction_ratio/table.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <string>

#include "coefficients.hpp"
#include "slipfront/error.hpp"

namespace slipfront::friction_ratio {
namespace {

/// T_0 ... T_(n-1) and their slopes at t.
template <std::size_t n>
struct Chebyshev {
  std::array<double, n> value, slope;
  explicit Chebyshev(double t) {
    value[0] = 1, value[1] = t;
    slope[0] = 0, slope[1] = 1;
    for (std::size_t i = 2; i < n; ++i) {
      value[i] = 2 * t * value[i - 1] - value[i - 2];
      slope[i] = 2 * value[i - 1] + 2 * t * slope[i - 1] - slope[i - 2];
    }
  }
};

void check(double stress, double damping) {
  const auto refuse = [](const char* key, double value, const char* allowed) {
    throw InputError({.key = key, .value = std::to_string(value), .problem = "out of range", .allowed = allowed});
  };
  if (!(stress >= layout::least_stress && stress <= layout::most_stress)) refuse("stress", stress, "0.05 ... 3");
  if (!(damping >= 0) || std::isinf(damping)) refuse("damping_number", damping, ">= 0, finite");
}

}  // namespace

Ratio evaluate(Measure measure, modulation::Closure closure, double stress, double damping) {
  check(stress, damping);
  const double tabled = std::fmin(damping, layout::most_damping);
  const auto above = std::upper_bound(layout::ends.begin() + 1, layout::ends.end() - 1, tabled);
  const auto piece = static_cast<std::size_t>(above - layout::ends.begin()) - 1;
  const layout::Range u_range = layout::of_piece(piece), y_range = layout::of_stress();
  const Chebyshev<layout::u_nodes> u(u_range.to_unit(std::log1p(tabled)));
  const Chebyshev<layout::y_nodes> y(y_range.to_unit(layout::y_of(stress)));
  const layout::Piece& c =
      coefficients[closure == modulation::Closure::paper ? 1 : 0][static_cast<std::size_t>(measure)][piece];
  double sum = 0, by_u = 0, by_y = 0;
  for (std::size_t i = 0; i < layout::y_nodes; ++i) {
    double along = 0, slope = 0;
    for (std::size_t j = 0; j < layout::u_nodes; ++j) {
      along += c[i][j] * u.value[j];
      slope += c[i][j] * u.slope[j];
    }
    sum += y.value[i] * along;
    by_u += y.value[i] * slope;
    by_y += y.slope[i] * along;
  }
  Ratio r{std::exp(sum), 0, 0};
  r.by_stress = r.value * by_y * y_range.unit_slope() * layout::y_slope(stress);
  r.by_damping = r.value * by_u * u_range.unit_slope() / (1 + damping);
  if (damping > layout::most_damping) {  // nonlinear diffusion: W ~ Gamma^(-1/2)
    const double fall = std::sqrt(layout::most_damping / damping);
    r = {r.value * fall, -r.value * fall / (2 * damping), r.by_stress * fall};
  }
  return r;
}

double uncertainty(modulation::Closure closure, double damping) {
  if (closure == modulation::Closure::paper)
    return damping > layout::unstable_from && damping < layout::unstable_to ? 1e-2 : 1e-4;
  return damping > layout::corner_from && damping < layout::corner_to ? 1e-3 : 1e-4;
}

StressRange stress_range() { return {layout::least_stress, layout::most_stress}; }

}  // namespace slipfront::friction_ratio
