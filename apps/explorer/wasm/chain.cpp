/// \file
/// The functions of panel "Dislocations", which shows every dislocation of a scenario while the chain runs.

#include <algorithm>
#include <cmath>
#include <functional>
#include <memory>
#include <numbers>
#include <span>

#include "lattice/chain/observe/averages.hpp"
#include "lattice/chain/scaled_start.hpp"
#include "scenario.hpp"
#include "slipfront/error.hpp"
#include "slipfront/lattice/chain/run.hpp"
#include "slipfront/scenario/problem.hpp"
#include "system/machine.hpp"

namespace slipfront::explorer {
namespace {

constexpr std::size_t most_chain_sites = 200000;
constexpr int average_points = 200;

/// The chain that the panel shows. Lengths and times are in the units of the scenario.
struct LiveChain {
  double scale = 1, left = 0, right = 0, end = 0, window = 0;
  std::unique_ptr<chain::Chain> chain;
};

LiveChain& live_chain() {
  static LiveChain now;
  return now;
}

std::unique_ptr<chain::Chain> started(const chain::ScaledProblem& s) {
  const std::size_t sites = chain::problem_of(s).grid.sites;
  if (sites > most_chain_sites)
    throw InputError({.key = "chain.scale",
                      .problem = "too many sites for a page: " + std::to_string(sites),
                      .allowed = "a smaller scale; slipfront chain runs larger ones"});
  const chain::ScaledStart start = chain::scaled_start(s);
  return chain::make_chain(start.problem, std::cref(start.train));
}

}  // namespace

/// Starts the chain of a scenario, with a scale that gives about `dislocations` dislocations in the domain. If that is
/// 0, the scale is that of the scenario. Averages are over `window` dislocations.
SLIPFRONT_EXPORT const char* chain_begin(const char* toml, int dislocations, double window) {
  return answer([=] {
    const scenario::Scenario s = scenario_of(toml);
    chain::ScaledProblem problem = scenario::chain_problem(s);
    constexpr int samples = 2000;
    double number = 0;  // number of dislocations at scale 1
    for (int i = 0; i < samples; ++i)
      number += s.stress(problem.left + (problem.right - problem.left) * (i + 0.5) / samples) / samples;
    number *= (problem.right - problem.left) / (2 * std::numbers::pi);
    if (dislocations > 0) problem.scale = dislocations / number;
    LiveChain& now = live_chain();
    now = {problem.scale, problem.left, problem.right, s.end, 0, nullptr};
    now.window = std::min(window, number * problem.scale) / (number * problem.scale) * (problem.right - problem.left);
    now.chain = started(problem);
    const chain::Grid& grid = now.chain->problem().grid;
    return Object()
        .put("scale", now.scale)
        .put("left", now.left)
        .put("right", now.right)
        .put("end", now.end)
        .put("sites", static_cast<long>(grid.sites))
        .put("spacing", grid.spacing)
        .put("warnings", s.warnings)
        .put("dislocations", static_cast<long>(chain::dislocations(*now.chain).size()));
  });
}

/// Advances the chain to a time of the scenario, for at most so many milliseconds. Returns the positions of the
/// dislocations. If `half` > 0, it also returns averages, and the stress and velocity of the sites within `half` of x =
/// 0.
SLIPFRONT_EXPORT const char* chain_go(double time, double milliseconds, double half) {
  return answer([=] {
    LiveChain& now = live_chain();
    if (!now.chain) throw InputError({.key = "chain", .problem = "no chain was started"});
    chain::Chain& c = *now.chain;
    const auto begun = Clock::now();
    bool reached = c.advance_to(time * now.scale, 32);
    while (!reached && 1e3 * seconds_since(begun) <= milliseconds) reached = c.advance_to(time * now.scale, 32);
    std::vector<double> place, sign;
    for (const chain::Dislocation& d : chain::dislocations(c)) {
      place.push_back(d.x / now.scale);
      sign.push_back(d.sign);
    }
    Object object;
    object.put("reached", reached).put("time", c.time() / now.scale).put("steps", c.steps());
    object.numbers("x", place).numbers("sign", sign);
    if (!(half > 0)) return object;
    const chain::Grid& grid = c.problem().grid;
    const chain::Window all = c.window(0, grid.sites);
    std::vector<double> x, W, Sigma;
    for (int i = 0; i < average_points; ++i) {
      x.push_back(now.left + (now.right - now.left) * (i + 0.5) / average_points);
      const auto mean = chain::smooth_average(
          c, all, chain::weights_of_smooth_mean(c.problem().grid, now.scale * x.back(), now.scale * now.window));
      W.push_back(mean.velocity);
      Sigma.push_back(mean.stress);
    }
    object.numbers("average_x", x).numbers("W", W).numbers("Sigma", Sigma);
    const auto site = [&](double at) {
      const double j = (at * now.scale - grid.left) / grid.spacing;
      return static_cast<std::size_t>(std::clamp(j, 0.0, static_cast<double>(grid.sites - 1)));
    };
    const std::size_t from = site(-half), count = site(half) + 1 - from;
    const auto near = [&](const std::vector<double>& values) { return std::span(values).subspan(from, count); };
    std::vector<double> near_x(near(all.x).begin(), near(all.x).end());
    for (double& at : near_x) at /= now.scale;
    return object.numbers("near_x", near_x)
        .numbers("near_velocity", near(all.velocity))
        .numbers("near_stress", near(all.stress));
  });
}

}  // namespace slipfront::explorer
