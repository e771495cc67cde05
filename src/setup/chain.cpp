#include "slipfront/setup/chain.hpp"

#include <cmath>

#include "slipfront/rupture/inverse.hpp"
#include "slipfront/setup/pulse.hpp"
#include "slipfront/train/train.hpp"

namespace slipfront::setup {
namespace {

chain::End end_of(scenario::ChainEnd end) {
  switch (end) {
    case scenario::ChainEnd::free:
      return chain::End::free;
    case scenario::ChainEnd::absorbing:
      return chain::End::absorbing;
    case scenario::ChainEnd::fixed:
      break;
  }
  return chain::End::fixed;
}

/// The default spacing in widths of a dislocation where they are narrowest: by the contact ratio, or packed densely.
double chosen_spacing(const scenario::Scenario& s, double left, double right) {
  double narrowest = 1;
  constexpr int samples = 1000;
  for (int i = 0; i <= samples; ++i) {
    const double x = left + (right - left) * i / samples, a = s.contact_at ? s.contact_at(x) : 1, k = s.stress(x);
    const double packed = k / a > train::smallest_stress ? std::cosh(rupture::psi_of_stress(k / a)) : 1;
    narrowest = std::fmin(narrowest, 1 / (a * (packed > 1.05 ? packed : 1)));
  }
  return chain::default_spacing * narrowest;
}

}  // namespace

chain::ScaledProblem chain_problem(const scenario::Scenario& s) {
  const pulse::Problem pulse = pulse_problem(s);
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
  c.boundary = {.left = end_of(s.chain.left), .right = end_of(s.chain.right), .periodic = s.chain.periodic};
  c.window = s.chain.window.value_or(0);
  if (s.chain.model == scenario::ChainModel::lattice) {
    c.model = chain::Model::lattice;
    const auto spacing = s.chain.spacing ? s.chain.spacing : s.medium.contact_ratio;
    if (!spacing)
      throw InputError({.file = s.file,
                        .key = "chain.spacing",
                        .problem = "a lattice needs its spacing, which is the contact ratio A",
                        .allowed = "[chain] spacing = ... or [medium] contact_ratio = ..."});
    c.spacing = *spacing;
  } else {
    c.spacing = s.chain.spacing ? *s.chain.spacing : chosen_spacing(s, c.left, c.right);
  }
  return c;
}

}  // namespace slipfront::setup
