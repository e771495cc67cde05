#include <algorithm>
#include <cmath>

#include "foundation/text/digits.hpp"
#include "setup/estimate.hpp"
#include "setup/hold.hpp"
#include "setup/output_times.hpp"
#include "slipfront/rupture/riemann.hpp"
#include "slipfront/rupture/riemann_trains.hpp"
#include "slipfront/setup/plane.hpp"
#include "slipfront/setup/problem.hpp"
#include "slipfront/train/train.hpp"

namespace slipfront::setup {
namespace {

/// x/t of the fronts of a step without friction.
rupture::Edges edges_of_step(const scenario::Scenario& s) {
  const State left = train::at_rest(s.initial.stress_left), right = train::at_rest(s.initial.stress_right);
  return s.friction.acts() ? rupture::edges_of(rupture::solve_riemann(left, right))
                           : rupture::edges_of(rupture::solve_trains(left, right));
}

/// How far waves from a step reach by the end: the frictionless fronts, or the diffusion length where friction rules.
struct Reach {
  double left, right;
};
Reach reach_of(const scenario::Scenario& s) {
  const rupture::Edges edges = edges_of_step(s);
  const double left = std::fabs(edges.left), right = std::fabs(edges.right);
  const double damping_number = s.friction.linear_coefficient().value_or(0) * s.end;
  const double share = std::fmin(1, 8 / std::sqrt(1 + damping_number));
  const double blur = s.initial.reach;
  return {1.15 * share * left * s.end + blur, 1.15 * share * right * s.end + blur};
}

void require_averages(const scenario::Scenario& s) {
  const auto refuse = [&](std::string key, std::string value, const char* problem, const char* allowed) {
    throw InputError(
        {.file = s.file, .key = std::move(key), .value = std::move(value), .problem = problem, .allowed = allowed});
  };
  if (s.loading.acts())
    refuse(
        "loading.stiffness", "",
        "the averages conserve the number of dislocations, and loading creates them; pulse does not have the rule for "
        "births at an end (docs/theory/7_loading.md, 7.4)",
        "slipfront chain, where dislocations arise without a rule");
  for (const friction::Parameter& p : s.friction.definition().parameters)
    if (p.only_on_chain && s.friction.parameter(p.name) != 0)
      refuse(
          "friction." + std::string(p.name), digits(s.friction.parameter(p.name)),
          "the averages have a contact a(x) that stays: the pressure of a train whose contacts or pores follow theta "
          "is not among them (docs/friction.md)",
          "slipfront chain, which has both exactly");
  if (!s.friction.defined_by(s.friction.closure()))
    refuse("friction.closure", "paper", "is not defined for a law with state variables", "consistent");
  const bool unresolved = s.friction.acts() && s.friction.steep_at_rest() && !s.friction.sticks();
  if (s.pulse.periodic && (s.friction.state_size() > 0 || unresolved))
    refuse("pulse.periodic", "true",
           unresolved ? "friction whose slope is infinite at rest, as of exponents below 1, leaves no time step short "
                        "enough on a ring"
                      : "a pulse run does not support state variables of friction on a ring",
           "false, or slipfront chain");
  if (!s.substrate)
    refuse("interface.contact", "0", "without a substrate there are no dislocations to average over",
           "slipfront chain, or a contact > 0");
}

/// Several trains at one position are exact without friction and load. Ends at which trains are reflected are not among
/// them.
void require_free_motion(const scenario::Scenario& s, const pulse::Problem& p) {
  const bool at_wall = p.left_end == pulse::End::fixed || p.right_end == pulse::End::fixed;
  const char* const there = p.friction.acts() ? "there is friction"
                            : p.forcing       ? "there is a load"
                            : p.contact       ? "the contact ratio changes along x"
                            : p.periodic      ? "the domain is a ring"
                            : at_wall         ? "a wall is at an end of the domain"
                                              : nullptr;
  if (there)
    throw InputError({.file = s.file,
                      .key = "pulse.trains",
                      .value = "many",
                      .problem = std::string("the averages of several trains are not known where ") + there,
                      .allowed = "trains = \"one\", or slipfront chain"});
}

}  // namespace

pulse::Problem stated_problem(const scenario::Scenario& s) {
  require_line(s);
  pulse::Problem p{.stress = s.stress,
                   .forcing = {},
                   .contact = s.contact_at,
                   .friction = s.friction,
                   .cells = s.pulse.cells,
                   .tolerance = s.pulse.tolerance};
  const bool known = s.initial.even_ends && !s.contact_at;
  if (!known && !(s.domain.left && s.domain.right))
    throw InputError({.file = s.file,
                      .key = "domain",
                      .problem = s.friction.changes_contacts() ? "left and right are needed where contacts change"
                                 : s.contact_at                ? "left and right are needed with a contact profile"
                                                               : "left and right are needed for this profile",
                      .allowed = "[domain] left = ..., right = ..."});
  const Reach reach = known ? reach_of(s) : Reach{0, 0};
  // A forcing carries dislocations along; through a domain made for slow waves it would carry them without end.
  constexpr double slow = 0.01;  // waves, in units of c
  if (s.forcing_at && !(s.domain.left && s.domain.right) && std::fmax(reach.left, reach.right) < slow * s.end)
    throw InputError(
        {.file = s.file,
         .key = "domain",
         .problem = "left and right are needed with a forcing where waves are as slow as here: they reach " +
                    digits(std::fmax(reach.left, reach.right)) + ", dislocations farther",
         .allowed = "[domain] left = ..., right = ..."});
  p.left = s.domain.left.value_or(-reach.left);
  p.right = s.domain.right.value_or(reach.right);
  if (!(p.left < p.right))
    throw InputError({.file = s.file,
                      .key = s.domain.left ? "domain.left" : "domain.right",
                      .value = digits(s.domain.left ? p.left : p.right),
                      .problem = "out of range",
                      .allowed = s.domain.left ? "< " + digits(p.right) : "> " + digits(p.left)});
  p.left_end = s.pulse.left;
  p.right_end = s.pulse.right;
  p.periodic = s.pulse.periodic;
  p.many_trains = s.pulse.many_trains;
  p.forcing = forcing_of(s, p.left, p.right);
  if (s.forcing_at) {
    p.longest_step = s.end / 100;  // so that no short pulse of it is stepped over
    p.explicit_tolerance /= 5;     // and what it gives where it jumps is right to 1e-5
  }
  p.corner = s.initial.jumps ? 0 : HUGE_VAL;
  return p;
}

pulse::Problem pulse_problem(const scenario::Scenario& s) {
  require_averages(s);
  pulse::Problem problem = stated_problem(s);
  if (problem.many_trains)
    require_free_motion(s, problem);
  else if (std::find(s.output.variables.begin(), s.output.variables.end(), "trains") != s.output.variables.end())
    throw InputError({.file = s.file,
                      .key = "output.variables",
                      .value = "trains",
                      .problem = "a run with one train at each position does not count trains",
                      .allowed = "with pulse.trains = \"many\""});
  return problem;
}

output::Schedule pulse_schedule(const scenario::Scenario& s, const pulse::Problem& problem) {
  require_memory(s, problem);
  output::Schedule schedule;
  schedule.threshold = s.pulse.threshold;
  schedule.per_event = static_cast<std::size_t>(s.output.per_event);
  schedule.times = output_times(s);
  for (int i = 0; i <= problem.cells; ++i)
    schedule.x_edges.push_back(i == problem.cells ? problem.right
                                                  : problem.left + (problem.right - problem.left) * i / problem.cells);
  return schedule;
}

}  // namespace slipfront::setup
