/// \file
/// The functions of panel "Stick-slip": a block, or a chain of blocks, that springs pull. All numbers are in SI units.

#include <algorithm>
#include <cmath>
#include <functional>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "lattice/chain/scaled_start.hpp"
#include "scenario.hpp"
#include "slipfront/error.hpp"
#include "slipfront/lattice/chain/run.hpp"
#include "slipfront/scenario/problem.hpp"
#include "slipfront/text/output/slip_event.hpp"
#include "slipfront/theory/medium/si_units.hpp"
#include "system/machine.hpp"

namespace slipfront::explorer {
namespace {

constexpr std::size_t most_loaded_sites = 400;

/// The units of the panel's numbers, in SI units.
struct Units {
  double time = 1, length = 1, load = 1, slip = 1, velocity = 1;
};

/// The run of the panel, and what it showed last. Values are in the units of the chain.
struct LiveLoading {
  std::unique_ptr<chain::Chain> chain;
  medium::SiUnits si;
  Units unit;
  double end = 0;
  std::vector<double> u_at_start;
  double time = -1, load = 0, speed = 0, most_load = 0;
};

std::unique_ptr<LiveLoading>& live_loading() {
  static std::unique_ptr<LiveLoading> now;
  return now;
}

/// Results that the page has not got yet, in SI units. Those of all sites follow one another.
struct Results {
  std::vector<double> time, load, speed, slip, velocity;
};

chain::ScaledProblem loaded_problem(const scenario::Scenario& s) {
  if (!s.loading.acts())
    throw InputError({.key = "loading.stiffness", .problem = "no spring pulls", .allowed = "a stiffness > 0"});
  chain::ScaledProblem problem = scenario::chain_problem(s);
  if (problem.scale != 1) throw InputError({.key = "chain.scale", .problem = "not 1", .allowed = "1 on this page"});
  const std::size_t sites = chain::problem_of(problem).grid.sites;
  if (sites > most_loaded_sites)
    throw InputError({.key = "chain.spacing",
                      .problem = "too many sites for a page: " + std::to_string(sites),
                      .allowed = "at most " + std::to_string(most_loaded_sites) + "; slipfront chain runs more"});
  return problem;
}

bool pulls_an_end(const chain::Chain& chain) { return chain.problem().loading.where != chain::Pulled::everywhere; }

/// Looks at the chain after a step. A result is kept if something has changed visibly since the last one.
void look(LiveLoading& now, Results& results) {
  const chain::Chain& c = *now.chain;
  const chain::Window all = c.window(0, c.problem().grid.sites);
  double speed = 0;
  for (const double v : all.velocity) speed = std::fmax(speed, std::fabs(v));
  const double load = c.load();
  now.most_load = std::fmax(now.most_load, std::fabs(load));
  const bool later = now.time < 0 || c.time() >= now.end || c.time() - now.time > now.end / 400;
  const bool faster = std::fabs(std::log(std::fmax(speed, 1e-300) / std::fmax(now.speed, 1e-300))) > 0.25;
  if (!later && !faster && std::fabs(load - now.load) < 0.01 * now.most_load) return;
  now.time = c.time();
  now.load = load;
  now.speed = speed;
  results.time.push_back(now.time * now.unit.time);
  results.load.push_back(load * now.unit.load);
  results.speed.push_back(speed * now.unit.velocity);
  for (std::size_t j = 0; j < all.u.size(); ++j) {
    results.slip.push_back((all.u[j] - now.u_at_start[j]) * now.unit.slip);
    results.velocity.push_back(all.velocity[j] * now.unit.velocity);
  }
}

/// The slip events so far. Each has its quantities under their names in files, in SI units.
std::vector<Object> events_of(const LiveLoading& now) {
  const bool end = pulls_an_end(*now.chain);
  std::vector<Object> all;
  for (const output::SlipEvent& event : now.chain->events()) {
    Object& one = all.emplace_back();
    for (const output::SlipEventColumn& column : output::slip_event_columns()) {
      const Description about = output::description_of(column, end);
      one.put(column.key(), event.*column.value * now.si.of(about.dimensional_unit).value);
    }
  }
  return all;
}

}  // namespace

/// Starts the chain of a scenario with changes, which are lines "table.key=value".
SLIPFRONT_EXPORT const char* loading_begin(const char* toml, const char* changes) {
  return answer([=] {
    const scenario::Scenario s = scenario_of(toml, lines_of(changes));
    const chain::ScaledStart start = chain::scaled_start(loaded_problem(s));
    auto made = std::make_unique<LiveLoading>(LiveLoading{
        .chain = chain::make_chain(start.problem, std::cref(start.train)), .si = medium::SiUnits(s.medium)});
    const chain::Grid& grid = made->chain->problem().grid;
    const auto in_si = [&](std::string_view unit) { return made->si.of(unit).value; };
    made->unit = {.time = in_si("b / (c A)"),
                  .length = in_si("b / A"),
                  .load = in_si(pulls_an_end(*made->chain) ? "mu A / pi" : "mu A^2 / (pi (1 - nu))"),
                  .slip = in_si("b / (2 pi)"),
                  .velocity = in_si("c A / pi")};
    made->end = s.end;
    made->u_at_start = made->chain->window(0, grid.sites).u;
    std::vector<double> x, fronts;
    for (std::size_t j = 0; j < grid.sites; ++j) x.push_back(grid.x(j) * made->unit.length);
    for (const double at : made->chain->fronts().x) fronts.push_back(at * made->unit.length);
    const chain::Loading& loading = made->chain->problem().loading;
    live_loading() = std::move(made);
    const LiveLoading& now = *live_loading();
    return Object()
        .put("end", now.end * now.unit.time)
        .put("pulls_an_end", pulls_an_end(*now.chain))
        .put("velocity", loading.velocity * now.unit.velocity)
        .put("stiffness_ratio", scenario::numbers_of(s).stiffness_ratio)
        .put("warnings", s.warnings)
        .numbers("x", x)
        .numbers("fronts_x", fronts);
  });
}

/// Advances the chain for at most so many milliseconds. Returns the results since the last call, and all slip events
/// with the times after their onset at which they arrived.
SLIPFRONT_EXPORT const char* loading_go(double milliseconds) {
  return answer([=] {
    if (!live_loading()) throw InputError({.key = "chain", .problem = "no chain was started"});
    LiveLoading& now = *live_loading();
    const auto begun = Clock::now();
    Results results;
    if (now.time < 0) look(now, results);
    bool reached = false;
    do {
      reached = now.chain->advance_to(now.end, 1);
      if (now.chain->between_steps() || reached) look(now, results);
    } while (!reached && 1e3 * seconds_since(begun) <= milliseconds);
    const std::vector<output::SlipEvent> events = now.chain->events();
    const output::FrontRecords fronts = now.chain->fronts();
    std::vector<double> arrivals;
    for (std::size_t i = 0; i < fronts.events.size(); ++i)
      for (const double at : fronts.events[i].arrival) arrivals.push_back((at - events[i].onset) * now.unit.time);
    return Object()
        .put("finished", reached)
        .put("steps", now.chain->steps())
        .put("now", now.chain->time() * now.unit.time)
        .put("events", events_of(now))
        .numbers("arrivals", arrivals)
        .numbers("time", results.time)
        .numbers("load", results.load)
        .numbers("speed", results.speed)
        .numbers("slip", results.slip)
        .numbers("velocity", results.velocity);
  });
}

}  // namespace slipfront::explorer
