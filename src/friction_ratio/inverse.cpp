#include <cmath>

#include "foundation/text/digits.hpp"
#include "friction_ratio/layout.hpp"
#include "slipfront/error.hpp"
#include "slipfront/friction_ratio/table.hpp"

namespace slipfront::friction_ratio {
namespace {

/// Least damping number in [0, the table's last] whose ratio is `ratio`, by bisection in ln(1 + Gamma): the ratio
/// falls.
double inside(Measure measure, friction::Closure closure, double stress, double ratio) {
  double low = 0, high = std::log1p(layout::most_damping);
  while (high - low > 1e-15 * high) {
    const double middle = low + (high - low) / 2;
    if (middle <= low || middle >= high) break;
    (evaluate(measure, closure, stress, std::expm1(middle)).value > ratio ? low : high) = middle;
  }
  return std::expm1(low + (high - low) / 2);
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
