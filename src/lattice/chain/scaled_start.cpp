#include "lattice/chain/scaled_start.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <numbers>
#include <optional>
#include <utility>

#include "lattice/chain/explicit/explicit_chain.hpp"
#include "lattice/chain/implicit/implicit_chain.hpp"
#include "math/digits.hpp"
#include "slipfront/error.hpp"
#include "system/ranks.hpp"

namespace slipfront::chain {
namespace {

/// Whether the forcing is too weak to make pairs of dislocations and antidislocations: for that it has to lift u out of
/// a well, |F| >= 1 in the chain's units.
bool weak_forcing(const ScaledProblem& s) {
  constexpr int positions = 256, times = 16;
  if (!(s.end > 0)) return false;
  double most = 0;
  for (int i = 0; i <= positions; ++i)
    for (int k = 0; k <= times; ++k)
      most = std::fmax(most, std::fabs(s.forcing(s.left + (s.right - s.left) * i / positions, s.end * k / times)));
  return most < 0.1 * s.scale;
}

/// Antidislocations come in at free ends and are made by a strong force; a slope of a(x) drives one stream through
/// another.
double crossing_stress(const ScaledProblem& s) {
  const bool free = !s.boundary.periodic && (s.boundary.left != End::fixed || s.boundary.right != End::fixed);
  if (!free && !s.contact && (!s.forcing || weak_forcing(s))) return 0;
  constexpr int samples = 4096;
  double most = 0;
  for (int i = 0; i <= samples; ++i) most = std::fmax(most, s.stress(s.left + (s.right - s.left) * i / samples));
  return most;
}

/// The sites of a chain of this length. Those of a lattice keep their spacing, so that the last may lie outside the
/// domain. A ring has one site less than other chains: the last is the first again.
Grid grid_of(const ScaledProblem& s) {
  const double length = s.scale * (s.right - s.left), intervals = std::ceil(length / s.spacing - 1e-9);
  if (!(intervals >= 1 && intervals < 1e15))
    throw InputError({.key = "spacing",
                      .value = digits(s.spacing),
                      .problem = "does not divide a chain of length " + digits(length),
                      .allowed = "> 0, for 1 to 1e15 sites"});
  // A spacing that divides the chain stays, so that it does not depend on the rounding of units.
  const bool stays = intervals * s.spacing - length < 1e-9 * s.spacing;
  const bool longer = s.model == Model::lattice && !s.boundary.periodic;
  return {.left = s.scale * s.left,
          .spacing = stays || longer ? s.spacing : length / intervals,
          .sites = static_cast<std::size_t>(intervals) + (s.boundary.periodic ? 0 : 1)};
}

}  // namespace

Problem problem_of(const ScaledProblem& s, double share_of_machine) {
  assert(s.scale > 0 && std::isfinite(s.scale));
  Problem p;
  p.grid = grid_of(s);
  p.model = s.model;
  p.boundary = s.boundary;
  p.friction = s.friction.scaled_by(s.scale);
  if (s.forcing) p.forcing = [f = s.forcing, c = s.scale](double x, double t) { return f(x / c, t / c) / c; };
  p.steady_forcing = s.steady_forcing;
  if (s.contact) p.contact = [a = s.contact, c = s.scale](double x) { return a(x / c); };
  p.crossing_stress = crossing_stress(s);
  p.step = s.step;
  p.loading = s.loading;
  const double softer = s.loading.where == Pulled::everywhere ? s.scale * s.scale : s.scale;
  p.loading.stiffness /= softer;
  if (s.loading.stiffness_at)
    p.loading.stiffness_at = [at = s.loading.stiffness_at, softer, c = s.scale](double x) {
      return at(x / c) / softer;
    };
  if (s.loading.velocity_at)
    p.loading.velocity_at = [at = s.loading.velocity_at, c = s.scale](double x) { return at(x / c); };
  p.substrate = s.substrate;
  p.implicit = s.implicit || s.loading.acts();
  p.tolerance = s.tolerance;
  p.phases_of_32_bits = s.phases_of_32_bits;
  p.longest = s.scale * s.end;
  p.boundary.left_stress = s.stress(s.left);
  p.boundary.right_stress = s.stress(s.right);
  check(p, share_of_machine);
  return p;
}

ScaledStart scaled_start(const ScaledProblem& s, double share_of_machine) {
  Problem problem = problem_of(s, share_of_machine);
  StaticTrain train([s](double x) { return s.stress(std::clamp(x / s.scale, s.left, s.right)); }, problem.grid,
                    s.boundary.periodic, problem.contact);
  if (s.boundary.periodic) {  // as many dislocations as the stress asks for
    const std::size_t n = problem.grid.sites;
    const double once_around = train(0, 1).u[0] - train(n - 1, n).u[0];
    const double share = static_cast<double>(n) / std::max<double>(1, static_cast<double>(n) - 1);
    problem.boundary.charge = std::lround(once_around * share / (2 * std::numbers::pi));
  }
  return {std::move(problem), std::move(train)};
}

ScaledStart scaled_start(const ScaledProblem& scaled, const Execution& execution) {
  if (!execution.ranks) return scaled_start(scaled, 1.0);
  std::optional<ScaledStart> made;
  execution.ranks->together([&] { made = scaled_start(scaled, execution.ranks->share_of_machine()); });
  return *std::move(made);
}

std::unique_ptr<Chain> make_chain(const Problem& problem, const MotionOf& start, const Execution& execution) {
  if (problem.implicit) return std::make_unique<ImplicitChain>(problem, start, execution);
  return std::make_unique<ExplicitChain>(problem, start, execution);
}

}  // namespace slipfront::chain
