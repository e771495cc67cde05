#include <cmath>

#include "foundation/math/bracket.hpp"
#include "foundation/text/digits.hpp"
#include "friction_ratio/layout.hpp"
#include "slipfront/error.hpp"
#include "slipfront/friction_ratio/table.hpp"

namespace slipfront::friction_ratio {
namespace {

/// Least damping number in [0, the table's last] whose ratio is `ratio`, by bisection in ln(1 + Gamma): the ratio
/// falls.
double inside(Measure measure, friction::Closure closure, double stress, double ratio) {
  const auto is_less_damped = [&](double log_damping) {
    return evaluate(measure, closure, stress, std::expm1(log_damping)).value > ratio;
  };
  return std::expm1(bisected({.holding = 0, .failing = std::log1p(layout::most_damping)}, is_less_damped).failing);
}

}  // namespace

Reading damping_number(Measure measure, friction::Closure closure, double stress, double ratio) {
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

}  // namespace slipfront::friction_ratio
