#pragma once
// Chains for the tests of loading and of implicit steps.

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>
#include <vector>

#include "lattice/chain/implicit/implicit_chain.hpp"
#include "lattice/chain/observe/totals.hpp"

namespace loaded {

using slipfront::chain::Chain;
using slipfront::chain::Motion;
using slipfront::chain::Problem;

inline constexpr double turn = 2 * std::numbers::pi;

/// Eight sites that slide as one block on a smooth surface.
inline Problem smooth_block() {
  Problem p;
  p.grid = {0, 0.5, 8};
  p.implicit = true;
  p.substrate = false;
  return p;
}

inline Motion at_rest(const Problem& p) { return {std::vector<double>(p.grid.sites, 0.0), {}}; }

inline slipfront::friction::Friction rate_and_state(double f0, double a, double b, double D, double w0, double theta,
                                                    bool slip_law = false) {
  for (const slipfront::friction::Definition* law : slipfront::friction::laws())
    if (law->name == "rate-and-state") return {*law, {f0, a, b, D, w0, theta, slip_law ? 1.0 : 0.0}};
  throw std::logic_error("no such law");
}

/// A block with laboratory friction. A spring pulls it, and it sticks and slips.
inline Problem block_of_laboratory() {
  Problem p = smooth_block();
  p.friction = rate_and_state(0.6, 0.01, 0.015, 1, 0.01, 100);
  p.loading = {.stiffness = 0.004, .velocity = 0.001, .event_velocity = 0.01};
  return p;
}

/// The relative error of the balance of energy and work. `first` is the energy at the start.
inline double budget(const Chain& chain, double first) {
  const slipfront::chain::Flows flows = chain.flows();
  const double energy = slipfront::chain::totals(chain).energy();
  return std::fabs(energy - first - (flows.supplied - flows.dissipated)) /
         std::max({1e-30, std::fabs(energy), std::fabs(flows.supplied)});
}

}  // namespace loaded
