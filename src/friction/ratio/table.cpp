#include "slipfront/friction/ratio/table.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <string>

#include "friction/ratio/layout.hpp"
#include "math/digits.hpp"
#include "math/roots.hpp"
#include "slipfront/error.hpp"

namespace slipfront::friction_ratio {
namespace {

void check(double stress, double damping) {
  const auto refuse = [](const char* key, double value, const char* allowed) {
    throw InputError({.key = key, .value = digits(value), .problem = "out of range", .allowed = allowed});
  };
  if (!(stress >= layout::least_stress && stress <= layout::most_stress)) refuse("stress", stress, "0.05 ... 3");
  if (!(damping >= 0) || std::isinf(damping)) refuse("damping_number", damping, ">= 0, finite");
}

constexpr std::array<const char*, layout::measures> measure_names = {"origin", "mean", "peak", "time-mean"};

/// The piece of the table at one point, and the arguments of its polynomials.
struct Position {
  const layout::Piece& polynomials;
  double t;             ///< y, between -1 and 1
  layout::Values<1> v;  ///< position in the piece between -1 and 1, and its slope over the share of the piece below u
  double length;        ///< length of the piece in u
  double motion;        ///< d/dy of the point of the piece at this share
};

Position position_of(SlipVelocityKind measure, friction::Closure closure, double stress, double damping) {
  check(stress, damping);
  const std::size_t c = closure == friction::Closure::paper ? 1 : 0, m = static_cast<std::size_t>(measure);
  const double t = layout::of_stress().to_unit(layout::y_of(stress));
  const auto ends = layout::ends_at(corners[c][m], t);
  const double u = std::log1p(std::fmin(damping, layout::most_damping));
  const auto above = std::upper_bound(ends.value.begin() + 1, ends.value.end() - 1, u);
  const auto piece = static_cast<std::size_t>(above - ends.value.begin()) - 1;
  const double low = ends.value[piece], length = ends.value[piece + 1] - low, x = (u - low) / length;
  return {coefficients[c][m][piece], t, layout::t_of(x, layout::by_root(corners[c][m], piece)), length,
          std::lerp(ends.slope[piece], ends.slope[piece + 1], x)};
}

}  // namespace

const char* name_of(SlipVelocityKind measure) { return measure_names[static_cast<std::size_t>(measure)]; }

SlipVelocityKind measure_named(std::string_view name, std::string_view key) {
  for (const SlipVelocityKind m : all_slip_velocity_kinds)
    if (name == name_of(m)) return m;
  throw InputError({.key = std::string(key),
                    .value = std::string(name),
                    .problem = "unknown",
                    .allowed = "origin, mean, peak, time-mean"});
}

Ratio evaluate(SlipVelocityKind measure, friction::Closure closure, double stress, double damping) {
  const Position p = position_of(measure, closure, stress, damping);
  const auto in_u = layout::chebyshev<layout::u_nodes>(p.v.value[0]);
  const auto in_y = layout::chebyshev<layout::y_nodes>(p.t);
  double sum = 0, by_v = 0, by_t = 0;
  for (std::size_t i = 0; i < layout::y_nodes; ++i) {
    double along = 0, slope = 0;
    for (std::size_t j = 0; j < layout::u_nodes; ++j) {
      along += p.polynomials[i][j] * in_u.value[j];
      slope += p.polynomials[i][j] * in_u.slope[j];
    }
    sum += in_y.value[i] * along;
    by_v += in_y.value[i] * slope;
    by_t += in_y.slope[i] * along;
  }
  const double by_u = by_v * p.v.slope[0] / p.length;
  // The ends of the piece move with y, so a derivative at constant u has a term for this motion.
  const double by_y = by_t * layout::of_stress().unit_slope() - by_u * p.motion;
  Ratio r{std::exp(sum), 0, 0};
  r.by_stress = r.value * by_y * layout::y_slope(stress);
  r.by_damping = r.value * by_u / (1 + damping);
  if (damping > layout::most_damping) {  // nonlinear diffusion: W and its mean in time fall as Gamma^(-1/2)
    const double fall = std::sqrt(layout::most_damping / damping);
    r = {r.value * fall, -r.value * fall / (2 * damping), r.by_stress * fall};
  }
  return r;
}

double evaluate_value(SlipVelocityKind measure, friction::Closure closure, double stress, double damping) {
  const Position p = position_of(measure, closure, stress, damping);
  const auto in_u = layout::chebyshev_values<layout::u_nodes>(p.v.value[0]);
  const auto in_y = layout::chebyshev_values<layout::y_nodes>(p.t);
  double sum = 0;
  for (std::size_t i = 0; i < layout::y_nodes; ++i) {
    double along = 0;
    for (std::size_t j = 0; j < layout::u_nodes; ++j) along += p.polynomials[i][j] * in_u[j];
    sum += in_y[i] * along;
  }
  const double value = std::exp(sum);
  return damping > layout::most_damping ? value * std::sqrt(layout::most_damping / damping) : value;
}

double uncertainty(friction::Closure closure, double damping) {
  const bool unstable = damping > layout::unstable_from && damping < layout::uncertain_to;
  return closure == friction::Closure::paper && unstable ? 1e-2 : 1e-4;
}

StressRange stress_range() { return {layout::least_stress, layout::most_stress}; }

namespace {

/// Least damping number in [0, the table's last] whose ratio is `ratio`, by bisection in ln(1 + Gamma): the ratio
/// falls.
double inside(SlipVelocityKind measure, friction::Closure closure, double stress, double ratio) {
  const auto is_less_damped = [&](double log_damping) {
    return evaluate(measure, closure, stress, std::expm1(log_damping)).value > ratio;
  };
  return std::expm1(bisected({.holding = 0, .failing = std::log1p(layout::most_damping)}, is_less_damped).failing);
}

}  // namespace

Reading damping_number(SlipVelocityKind measure, friction::Closure closure, double stress, double ratio) {
  const double most = evaluate(measure, closure, stress, 0).value;
  // Without friction the table is 1 only to its error.
  if (!(ratio > 0 && ratio <= most * (1 + uncertainty(closure, 0))))
    throw InputError({.key = "slip_velocity_ratio",
                      .value = digits(ratio),
                      .problem = "out of range",
                      .allowed = "above 0, at most " + digits(most) + " (no friction)"});
  if (ratio >= most) return {0, uncertainty(closure, 0) * most / -evaluate(measure, closure, stress, 0).by_damping};
  const double last = evaluate(measure, closure, stress, layout::most_damping).value;
  const double damping = ratio > last ? inside(measure, closure, stress, ratio)
                                      : layout::most_damping * std::pow(last / ratio, 2);  // W ~ Gamma^(-1/2)
  if (std::isinf(damping))
    throw InputError({.key = "slip_velocity_ratio",
                      .value = digits(ratio),
                      .problem = "too small for a damping number that is finite",
                      .allowed = "more than 1e-150"});
  const Ratio at = evaluate(measure, closure, stress, damping);
  return {damping, uncertainty(closure, damping) * at.value / std::abs(at.by_damping)};
}

namespace {

[[noreturn]] void refuse(const char* key, double value, const char* allowed) {
  throw InputError({.key = key, .value = digits(value), .problem = "out of range", .allowed = allowed});
}

std::size_t index_of(friction::Closure closure) { return closure == friction::Closure::paper ? 1 : 0; }

/// ln(1 + Gamma) at the ends of the pieces.
const std::array<double, front_layout::pieces + 1> log_ends = [] {
  std::array<double, front_layout::pieces + 1> u{};
  for (std::size_t i = 0; i < u.size(); ++i) u[i] = std::log1p(front_layout::ends[i]);
  return u;
}();

/// A sum of polynomials in y and u at one u: coefficients of polynomials in y, and their slopes by Gamma.
template <std::size_t n_y>
using Along = layout::Values<n_y>;

template <std::size_t n_y, class Number>
Along<n_y> at_damping_number(const Number* pieces, double damping) {
  constexpr std::size_t n_u = front_layout::u_nodes;
  if (!(damping >= 0) || std::isinf(damping)) refuse("damping_number", damping, ">= 0, finite");
  const double u = std::log1p(std::fmin(damping, layout::most_damping));
  std::size_t piece = 0;
  while (piece + 1 < front_layout::pieces && u >= log_ends[piece + 1]) ++piece;
  const layout::Range u_range{log_ends[piece], log_ends[piece + 1]};
  const auto in_u = layout::chebyshev<n_u>(u_range.to_unit(u));
  const Number* a = pieces + piece * n_y * n_u;
  Along<n_y> along{};
  for (std::size_t i = 0; i < n_y; ++i) {
    for (std::size_t j = 0; j < n_u; ++j) {
      const double coefficient = static_cast<double>(a[i * n_u + j]);
      along.value[i] += coefficient * in_u.value[j];
      along.slope[i] += coefficient * in_u.slope[j];
    }
    along.slope[i] *= u_range.unit_slope() / (1 + damping);
  }
  return along;
}

template <std::size_t n_y>
Ratio at_stress(const Along<n_y>& along, double stress) {
  if (!(stress >= layout::least_stress && stress <= layout::most_stress)) refuse("stress", stress, "0.05 ... 3");
  const layout::Range y_range = layout::of_stress();
  const auto in_y = layout::chebyshev<n_y>(y_range.to_unit(layout::y_of(stress)));
  Ratio sum{0, 0, 0};
  double by_y = 0;
  for (std::size_t i = 0; i < n_y; ++i) {
    sum.value += in_y.value[i] * along.value[i];
    sum.by_damping += in_y.value[i] * along.slope[i];
    by_y += in_y.slope[i] * along.value[i];
  }
  sum.by_stress = by_y * y_range.unit_slope() * layout::y_slope(stress);
  return sum;
}

}  // namespace

FrontCurve::FrontCurve(friction::Closure closure, double threshold)
    : coefficients_(front_layout::pieces * front_layout::front_y_nodes * front_layout::u_nodes) {
  if (!(threshold >= front_layout::least_threshold && threshold <= front_layout::most_threshold))
    refuse("threshold", threshold, "1e-4 ... 0.3");
  const auto weights =
      layout::chebyshev<front_layout::threshold_nodes>(front_layout::of_threshold().to_unit(std::log(threshold)));
  const auto& table = front_coefficients[index_of(closure)];
  for (std::size_t k = 0; k < table.size(); ++k) {
    auto sum = coefficients_.begin();
    for (const auto& piece : table[k])
      for (const auto& row : piece)
        for (const front_layout::Integer coefficient : row)
          *sum++ += weights.value[k] * front_layout::unit * coefficient;
  }
}

FrontAtDamping FrontCurve::at_damping(double damping) const {
  const auto along = at_damping_number<front_layout::front_y_nodes>(coefficients_.data(), damping);
  FrontAtDamping front;
  front.damping_ = damping, front.value_ = along.value, front.slope_ = along.slope;
  return front;
}

Ratio FrontAtDamping::operator()(double stress) const {
  const Ratio g = at_stress(Along<front_layout::front_y_nodes>{value_, slope_}, stress);
  const double sum = std::exp(g.value), r = std::exp(front_layout::blunt - sum), by_g = -r * sum;
  if (r >= 1) return {1, 0, 0};  // by the error of the table
  if (damping_ <= layout::most_damping) return {r, by_g * g.by_damping, by_g * g.by_stress};
  const double fall = std::sqrt(layout::most_damping / damping_);
  return {r * fall, -r * fall / (2 * damping_), by_g * g.by_stress * fall};
}

Ratio front_ratio(friction::Closure closure, double stress, double damping, double threshold) {
  return FrontCurve(closure, threshold)(stress, damping);
}

double front_uncertainty(friction::Closure closure, double damping) {
  if (closure == friction::Closure::consistent) return 1e-3;
  return uncertainty(closure, damping) > 1e-3 ? 3e-2 : 5e-3;
}

ThresholdRange threshold_range() { return {front_layout::least_threshold, front_layout::most_threshold}; }

Ratio stress_drop_share(Drop drop, friction::Closure closure, double stress, double damping) {
  const auto& pieces = drop_coefficients[index_of(closure)][static_cast<std::size_t>(drop)];
  const Ratio sum = at_stress(at_damping_number<front_layout::drop_y_nodes>(pieces[0][0].data(), damping), stress);
  const double share = std::exp(front_layout::unit * sum.value), by_sum = share * front_layout::unit;
  return {share, damping > layout::most_damping ? 0 : by_sum * sum.by_damping, by_sum * sum.by_stress};
}

double stress_drop_uncertainty(friction::Closure closure, double damping) {
  return uncertainty(closure, damping) > 1e-3 ? 1e-2 : 1e-3;
}

}  // namespace slipfront::friction_ratio
