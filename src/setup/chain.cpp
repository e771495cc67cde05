#include <cmath>

#include "foundation/text/digits.hpp"
#include "slipfront/setup/plane.hpp"
#include "slipfront/setup/problem.hpp"
#include "slipfront/train/train.hpp"

namespace slipfront::setup {
namespace {

/// The default spacing in widths of a dislocation where they are narrowest: by the contact ratio, or packed densely.
double chosen_spacing(const scenario::Scenario& s, double left, double right) {
  double narrowest = 1;
  const double growth = s.friction.contact_growth(s.end);
  constexpr int samples = 1000;
  for (int i = 0; i <= samples; ++i) {
    const double x = left + (right - left) * i / samples, a = s.contact_at ? s.contact_at(x) : 1, k = s.stress(x);
    const double packed = k / a > train::smallest_stress ? std::cosh(train::psi_of_stress(k / a)) : 1;
    narrowest = std::fmin(narrowest, 1 / (a * growth * (packed > 1.05 ? packed : 1)));
  }
  return chain::default_spacing * narrowest;
}

/// With fewer the chain's differences reach past both ends.
void require_sites(const scenario::Scenario& s, const chain::ScaledProblem& c) {
  constexpr double fewest = 8;
  const double sites = std::ceil(c.scale * (c.right - c.left) / c.spacing - 1e-9) + (c.boundary.periodic ? 0 : 1);
  if (!(sites < fewest)) return;
  throw InputError({.file = s.file,
                    .key = "chain.scale",
                    .value = digits(c.scale),
                    .problem = "makes a chain of " + digits(sites) + " sites, " + digits(c.spacing) + " apart",
                    .allowed = "at least 8 sites: a larger scale or domain, or a smaller chain.spacing"});
}

void require_fronts(const scenario::Scenario& s, const chain::ScaledProblem& c) {
  if (s.output.fronts == 0) return;
  const auto refuse = [&](const std::string& problem, const std::string& allowed) {
    throw InputError({.file = s.file,
                      .key = "output.fronts",
                      .value = std::to_string(s.output.fronts),
                      .problem = problem,
                      .allowed = allowed});
  };
  if (!s.loading.acts()) refuse("arrivals are recorded of the slip events of a loaded chain", "with [loading]");
  const double sites = std::floor(c.scale * (c.right - c.left) / c.spacing);
  if (s.output.fronts > sites) refuse("more positions than sites", "<= " + digits(sites));
}

/// The spacing of sites that a scenario states, or the default.
double spacing_of(const scenario::Scenario& s, double left, double right) {
  if (s.chain.spacing) return *s.chain.spacing;
  if (s.chain.model != chain::Model::lattice) return chosen_spacing(s, left, right);
  if (s.medium.contact_ratio) return *s.medium.contact_ratio;
  throw InputError({.file = s.file,
                    .key = "chain.spacing",
                    .problem = "a lattice needs its spacing, which is the contact ratio A",
                    .allowed = "[chain] spacing = ... or [medium] contact_ratio = ..."});
}

}  // namespace

chain::ScaledProblem chain_problem(const scenario::Scenario& s) {
  require_line(s);
  if (s.loading.acts() && !(s.domain.left && s.domain.right))
    throw InputError({.file = s.file,
                      .key = "domain",
                      .problem = "left and right are needed with [loading]",
                      .allowed = "[domain] left = ..., right = ..."});
  const pulse::Problem pulse = stated_problem(s);
  chain::ScaledProblem c;
  c.scale = s.chain.scale.value_or(1);
  c.left = pulse.left;
  c.right = pulse.right;
  c.stress = s.stress;
  c.forcing = pulse.forcing;  // with the load that holds the initial stress, if any
  c.steady_forcing = s.steady_forcing;
  c.end = s.end;
  c.contact = s.contact_at;
  c.friction = s.friction;
  c.boundary = {.left = s.chain.left, .right = s.chain.right, .periodic = s.chain.periodic};
  c.window = s.chain.window.value_or(0);
  c.model = s.chain.model;
  c.loading = s.loading;
  c.loading.fronts = static_cast<std::size_t>(s.output.fronts);
  c.substrate = s.substrate;
  c.implicit = s.chain.implicit;
  c.tolerance = s.chain.tolerance;
  if (!c.substrate && !c.implicit)
    throw InputError({.file = s.file,
                      .key = "interface.contact",
                      .value = s.contact,
                      .problem = "explicit steps are those of a substrate",
                      .allowed = "chain.steps = \"implicit\", [loading], or a contact > 0"});
  c.spacing = spacing_of(s, c.left, c.right);
  require_sites(s, c);
  require_fronts(s, c);
  return c;
}

}  // namespace slipfront::setup
