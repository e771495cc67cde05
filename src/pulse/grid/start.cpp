#include "pulse/grid/start.hpp"

#include <cassert>
#include <cmath>
#include <numbers>
#include <string>

#include "foundation/text/digits.hpp"
#include "pulse/grid/layout.hpp"
#include "slipfront/error.hpp"
#include "slipfront/train/train.hpp"

namespace slipfront::pulse {

using std::numbers::pi;

namespace {

/// A contact that jumps would be a wall to some cells and nothing to others: there must be a slope to climb.
void refuse_jumps(const std::function<double(double)>& contact, double left, double right) {
  constexpr int samples = 4096;
  const double h = (right - left) / samples;
  for (int i = 0; i < samples; ++i) {
    double a = left + i * h, b = a + h, at_a = contact(a), at_b = contact(b);
    const double whole = std::fabs(at_b - at_a), from = at_a, to = at_b;
    if (whole < 1e-3 * at_a) continue;
    while (b - a > 1e-6 * h) {  // the half that changes more
      const double middle = (a + b) / 2, at_middle = contact(middle);
      const bool first = std::fabs(at_middle - at_a) > std::fabs(at_b - at_middle);
      (first ? b : a) = middle;
      (first ? at_b : at_a) = at_middle;
    }
    if (std::fabs(at_b - at_a) > whole / 2)
      throw InputError({.key = "contact",
                        .problem = "jumps from " + digits(from) + " to " + digits(to) + " at x = " + digits(a),
                        .allowed = "a continuous profile, such as tanh of a width of some cells"});
  }
}

}  // namespace

Start start_of(const Problem& problem) {
  assert(problem.left < problem.right && problem.cells >= 4 && problem.tolerance > 0);
  assert(problem.friction.defined_by(problem.friction.closure()));
  if (problem.contact) refuse_jumps(problem.contact, problem.left, problem.right);
  const Layout layout = lay_cells(
      problem.stress, problem.left, problem.right, problem.cells, problem.corner,
      {!problem.periodic && problem.left_end == End::free, !problem.periodic && problem.right_end == End::free});
  if (problem.periodic && (layout.left_free || layout.right_free))
    throw InputError({.key = "periodic",
                      .problem = "there is no stress at an end of the domain",
                      .allowed = "a ring that is stressed where its ends meet"});
  Cells cells;
  cells.charge = layout.charge;
  const std::size_t n = layout.charge.size();
  cells.unknowns.assign(Values::size(n), 0.0);
  cells.s.assign(n, 0.0);
  for (std::size_t i = 0; i < n; ++i) {
    cells.width(i) = layout.faces[i + 1] - layout.faces[i];
    if (cells.charge[i] == 0) continue;
    const double a = problem.contact ? problem.contact((layout.faces[i] + layout.faces[i + 1]) / 2) : 1;
    const double local = 2 * pi * cells.charge[i] / (a * cells.width(i));
    if (!(local >= train::smallest_stress))
      throw InputError(
          {.key = problem.contact ? "contact" : "stress",
           .problem = "stress over contact ratio is " + digits(local) + " at x = " + digits(layout.faces[i]),
           .allowed = "at least 0.0045 where there is stress: dislocations farther apart have no psi"});
    cells.s[i] = std::tanh(train::psi_of_stress(local));
  }
  cells.left_edge() = layout.faces.front();
  return {cells, {layout.left_free, layout.right_free}};
}

}  // namespace slipfront::pulse
