#include "slipfront/setup/estimate.hpp"

#include <cmath>
#include <string>

#include "../digits.hpp"
#include "slipfront/error.hpp"
#include "slipfront/machine.hpp"

namespace slipfront::setup {
namespace {

constexpr double size = sizeof(double);
constexpr double observed_fields = 5;   // of pulse::Profile
constexpr double written_fields = 8;    // of a file, at most
constexpr double scalars = 16;          // of a snapshot
constexpr double solver_per_cell = 50;  // doubles: states, fluxes, the stages of a step and its Jacobian

}  // namespace

Estimate estimate_of(const scenario::Scenario& s, const pulse::Problem& problem) {
  const double cells = problem.cells;
  double outputs = 2 + static_cast<double>(s.output.times.size());
  if (s.output.every) outputs += std::ceil(s.end / *s.output.every) - 1;
  const double variables =
      s.output.variables.empty() ? written_fields : static_cast<double>(s.output.variables.size() + 1);
  // A file is made in memory before it is written.
  const double disk = size * (outputs * (cells * variables + scalars) + 8 * cells);
  return {outputs, size * (outputs * (observed_fields * cells + scalars) + solver_per_cell * cells) + disk, disk};
}

void require_memory(const scenario::Scenario& s, const pulse::Problem& problem) {
  const Estimate need = estimate_of(s, problem);
  const double have = usable_memory();
  if (need.memory <= have) return;
  const bool by_outputs = need.outputs > 1000;
  throw InputError({.file = s.file,
                    .key = by_outputs ? (s.output.every ? "output.every" : "output.times") : "pulse.cells",
                    .problem = digits(need.outputs, 4) + " outputs of " + digits(problem.cells, 4) + " cells need " +
                               digits(need.memory / 1e9, 3) + " GB of memory, this process may have " +
                               digits(have / 1e9, 3) + " GB",
                    .allowed = by_outputs ? "fewer outputs, or fewer output.variables" : "fewer cells or outputs"});
}

}  // namespace slipfront::setup
