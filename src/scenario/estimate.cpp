#include "scenario/estimate.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>

#include "math/digits.hpp"
#include "slipfront/error.hpp"
#include "system/machine.hpp"

namespace slipfront::scenario {
namespace {

constexpr double double_size = sizeof(double);
constexpr double observed_fields = 5;  // fields in output::Profile
constexpr double written_fields = 8;   // fields in a file, at most
constexpr double scalars = 16;         // scalars in a snapshot

/// Estimates outputs, memory and disk for the observations of a run, which are the same for a pulse and a chain.
Estimate observed(const Scenario& s) {
  const double cells = s.pulse.cells;
  double outputs = 2 + static_cast<double>(s.output.times.size());
  if (s.output.every) outputs += std::ceil(s.end / *s.output.every) - 1;
  const double variables =
      s.output.variables.empty() ? written_fields : static_cast<double>(s.output.variables.size() + 1);
  return {outputs, double_size * outputs * (observed_fields * cells + scalars),
          double_size * (outputs * (cells * variables + scalars) + 2 * cells)};
}

double sites_of(const chain::ScaledProblem& c) { return c.scale * (c.right - c.left) / c.spacing + 1; }

/// The number of dislocations in a chain at its start.
double dislocations_of(const chain::ScaledProblem& c) {
  constexpr int samples = 2000;
  double sum = 0;
  for (int i = 0; i < samples; ++i) sum += std::fabs(c.stress(c.left + (c.right - c.left) * (i + 0.5) / samples));
  return c.scale * (c.right - c.left) * sum / samples / (2 * std::numbers::pi);
}

/// Estimates memory and disk for u at the sites and for the dislocations of all outputs. Dislocations that come in
/// later are not counted.
Estimate of_sites(const Scenario& s, const chain::ScaledProblem& c, double outputs) {
  constexpr double in_file = 2 * double_size, in_memory = 9 * double_size;  // bytes for each dislocation
  const double displacements = s.output.displacement ? double_size * outputs * sites_of(c) : 0;
  const double dislocations = s.output.dislocations ? outputs * dislocations_of(c) : 0;
  return {outputs, displacements + in_memory * dislocations, displacements + in_file * dislocations};
}

double memory_of(const chain::ScaledProblem& c) {
  chain::Problem p;  // only the members on which memory depends
  p.friction = c.friction;
  p.forcing = c.forcing;
  p.contact = c.contact;
  p.grid.sites = static_cast<std::size_t>(std::clamp(sites_of(c), 1.0, 1e15));
  return chain::memory_needed(p);
}

void require(const Scenario& s, const Estimate& need, const char* key, const std::string& what, const char* allowed) {
  const double have = usable_memory();
  if (need.memory_with_file() <= have) return;
  const bool by_outputs = need.outputs > 1000;
  throw InputError({.file = s.file,
                    .key = by_outputs ? (s.output.every ? "output.every" : "output.times") : key,
                    .problem = digits(need.outputs, 4) + " outputs of " + digits(s.pulse.cells, 4) + " cells" + what +
                               " need " + digits(need.memory_with_file() / 1e9, 3) +
                               " GB of memory, this process may have " + digits(have / 1e9, 3) + " GB",
                    .allowed = by_outputs ? "fewer outputs, or fewer output.variables" : allowed});
}

/// Refuses output.displacement or output.dislocations if the run would fit without them.
void require_sites_fit(const Scenario& s, const chain::ScaledProblem& c, const Estimate& need) {
  const double have = usable_memory(), sites = of_sites(s, c, need.outputs).memory_with_file();
  if (need.memory_with_file() <= have || need.memory_with_file() - sites > have) return;
  throw InputError({.file = s.file,
                    .key = s.output.displacement ? "output.displacement" : "output.dislocations",
                    .value = "true",
                    .problem = digits(need.outputs, 4) + " outputs of " + digits(sites_of(c), 4) + " sites and " +
                               digits(dislocations_of(c), 4) + " dislocations need " +
                               digits(need.memory_with_file() / 1e9, 3) + " GB of memory, this process may have " +
                               digits(have / 1e9, 3) + " GB",
                    .allowed = "fewer outputs or sites, or false"});
}

}  // namespace

Estimate estimate_of(const Scenario& s, const pulse::Problem& problem) {
  Estimate need = observed(s);
  need.memory += pulse::Solver::memory_needed(problem.cells);
  need.disk += pulse::Solver::disk_needed(problem.cells);
  return need;
}

Estimate estimate_of(const Scenario& s, const chain::ScaledProblem& chain) {
  Estimate need = observed(s);
  const Estimate sites = of_sites(s, chain, need.outputs);
  need.memory += memory_of(chain) + sites.memory;
  need.disk += chain::disk_needed(sites_of(chain)) + sites.disk;
  return need;
}

Estimate estimate_of(const Scenario& s, const std::vector<chain::ScaledProblem>& chains) {
  const Estimate one = observed(s);
  const double levels = 3 + static_cast<double>(chains.size());  // the closed form, if any, comes later
  double largest = pulse::Solver::memory_needed(s.pulse.cells);
  for (const chain::ScaledProblem& chain : chains) largest = std::max(largest, memory_of(chain));
  // The level that runs now has its own copy of its observations, in addition to that of the comparison.
  return {one.outputs, (levels + 1) * one.memory + largest, levels * one.disk};
}

std::string in_words(const Estimate& need) {
  return digits(need.outputs, 9) + " snapshots: " + digits(need.memory_with_file() / 1e9, 3) + " GB of memory, " +
         digits(need.disk / 1e9, 3) + " GB on the disk with -o";
}

void require_memory(const Scenario& s, const pulse::Problem& problem) {
  require(s, estimate_of(s, problem), "pulse.cells", "", "fewer cells or outputs");
}

void require_memory(const Scenario& s, const chain::ScaledProblem& chain, double share_of_machine) {
  Estimate need = estimate_of(s, chain);
  need.memory -= (1 - share_of_machine) * memory_of(chain);
  require_sites_fit(s, chain, need);
  require(s, need, s.chain.spacing ? "chain.spacing" : "chain.scale", " and " + digits(sites_of(chain), 4) + " sites",
          "fewer sites, cells or outputs");
}

void require_memory(const Scenario& s, const std::vector<chain::ScaledProblem>& chains) {
  require(s, estimate_of(s, chains), "pulse.cells",
          ", " + digits(3.0 + static_cast<double>(chains.size())) + " levels together",
          "smaller scales, fewer cells or outputs");
}

}  // namespace slipfront::scenario
