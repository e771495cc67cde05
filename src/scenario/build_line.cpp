// The problems of a scenario on a line.

#include <algorithm>
#include <cmath>
#include <memory>
#include <numbers>
#include <vector>

#include "math/digits.hpp"
#include "scenario/estimate.hpp"
#include "scenario/functions.hpp"
#include "slipfront/math/elliptic.hpp"
#include "slipfront/scenario/problem.hpp"
#include "slipfront/theory/rupture/riemann.hpp"
#include "slipfront/theory/rupture/riemann_trains.hpp"
#include "slipfront/theory/train.hpp"

namespace slipfront::scenario {

std::vector<double> output_times(const Scenario& s) {
  std::vector<double> times = {0};
  for (const double t : s.output.times)
    if (t > 0 && t < s.end) times.push_back(t);
  if (s.output.every)
    for (double i = 1; i * *s.output.every < s.end * (1 - 1e-12); ++i) times.push_back(i * *s.output.every);
  times.push_back(s.end);
  return times;
}

namespace {

/// (4 / pi)(a cosh(psi) E - 1) of the train at rest at x: less 1 throughout, so that slow trains lose no digits.
double balance(const Scenario& s, double x) {
  const double a = s.contact_at ? s.contact_at(x) : 1, stress = s.stress(x);
  double rest = 0;  // cosh(psi) E - 1
  if (stress >= train::smallest_stress * a) {
    const double psi = train::psi_of_stress(stress / a), half = std::sinh(psi / 2);
    const double cosh_rest = 2 * half * half, E_rest = elliptic::at_psi(psi).E_rest;
    rest = cosh_rest + E_rest + cosh_rest * E_rest;
  }
  return 4 / std::numbers::pi * (a - 1 + a * rest);
}

/// A function of x by cubics through even samples.
class Sampled {
 public:
  Sampled(double left, double right, std::vector<double> values)
      : left_(left), h_((right - left) / static_cast<double>(values.size() - 1)), values_(std::move(values)) {}
  double operator()(double x) const {
    const double last = static_cast<double>(values_.size() - 1);
    const double position = std::clamp((x - left_) / h_, 0.0, last);
    const auto i = static_cast<std::size_t>(std::clamp(std::floor(position), 1.0, last - 2));
    const double s = position - static_cast<double>(i);
    const double *f = &values_[i], a = f[-1], b = f[0], c = f[1], d = f[2];
    return b + s * ((c - a) / 2 + s * (a - 2.5 * b + 2 * c - d / 2 + s * (1.5 * (b - c) + (d - a) / 2)));
  }

 private:
  double left_, h_;
  std::vector<double> values_;
};

/// Returns the forcing of a scenario on [left, right], or null if there is none. With `initial.hold` it adds a static
/// load that holds the initial stress at rest: F = g_x with g = (4 / pi) a cosh(psi) E. This load follows from M_t = 2
/// pi (F - g_x), which holds where nothing moves (docs/theory/6_contact.md).
std::function<double(double, double)> forcing_of(const Scenario& s, double left, double right) {
  if (!s.initial.hold) return s.forcing_at;
  constexpr int samples = 8192;
  const double h = (right - left) / samples;
  std::vector<double> load(samples + 1);
  for (int i = 0; i <= samples; ++i) {
    const double x = left + h * i, low = std::max(left, x - h / 8), high = std::min(right, x + h / 8);
    load[static_cast<std::size_t>(i)] = s.stress(x) > 0 ? (balance(s, high) - balance(s, low)) / (high - low) : 0;
  }
  const auto held = std::make_shared<const Sampled>(left, right, std::move(load));
  return [held, forcing = s.forcing_at](double x, double t) { return (*held)(x) + (forcing ? forcing(x, t) : 0); };
}

/// x/t of the fronts of a step without friction.
rupture::Edges edges_of_step(const Scenario& s) {
  const State left = train::at_rest(s.initial.stress_left), right = train::at_rest(s.initial.stress_right);
  return s.friction.acts() ? rupture::edges_of(rupture::solve_riemann(left, right))
                           : rupture::edges_of(rupture::solve_trains(left, right));
}

/// How far waves from a step reach by the end: the frictionless fronts, or the diffusion length where friction rules.
struct Reach {
  double left, right;
};
Reach reach_of(const Scenario& s) {
  const rupture::Edges edges = edges_of_step(s);
  const double left = std::fabs(edges.left), right = std::fabs(edges.right);
  const double damping_number = s.friction.linear_coefficient().value_or(0) * s.end;
  const double share = std::fmin(1, 8 / std::sqrt(1 + damping_number));
  const double blur = s.initial.reach;
  return {1.15 * share * left * s.end + blur, 1.15 * share * right * s.end + blur};
}

void require_averages(const Scenario& s) {
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

/// The effect of other friction on several trains at one position is not known, nor are ends that reflect trains.
void require_known_motion(const Scenario& s, const pulse::Problem& p) {
  const bool at_wall = p.left_end == pulse::End::fixed || p.right_end == pulse::End::fixed;
  const bool other_friction =
      p.friction.acts() && (!p.friction.linear_coefficient() || p.friction.closure() == friction::Closure::paper);
  const char* const there = other_friction ? "friction is not viscous with the consistent closure"
                            : p.contact    ? "the contact ratio changes along x"
                            : p.periodic   ? "the domain is a ring"
                            : at_wall      ? "a wall is at an end of the domain"
                                           : nullptr;
  if (there)
    throw InputError({.file = s.file,
                      .key = "pulse.trains",
                      .value = "many",
                      .problem = std::string("the averages of several trains are not known where ") + there,
                      .allowed = "trains = \"one\", or slipfront chain"});
}

void require_width(const Scenario& s, double left, double right) {
  if (left < right) return;
  throw InputError(
      {.file = s.file,
       .key = s.domain.left ? "domain.left" : "domain.right",
       .value = s.in_results(s.domain.left ? left : right, "b / A"),
       .problem = "out of range",
       .allowed = s.domain.left ? "< " + s.in_results(right, "b / A") : "> " + s.in_results(left, "b / A")});
}

}  // namespace

pulse::Problem stated_problem(const Scenario& s) {
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
                    s.in_results(std::fmax(reach.left, reach.right), "b / A") + ", dislocations farther",
         .allowed = "[domain] left = ..., right = ..."});
  p.left = s.domain.left.value_or(-reach.left);
  p.right = s.domain.right.value_or(reach.right);
  require_width(s, p.left, p.right);
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

pulse::Problem pulse_problem(const Scenario& s) {
  require_averages(s);
  pulse::Problem problem = stated_problem(s);
  if (problem.many_trains)
    require_known_motion(s, problem);
  else if (std::find(s.output.variables.begin(), s.output.variables.end(), "trains") != s.output.variables.end())
    throw InputError({.file = s.file,
                      .key = "output.variables",
                      .value = "trains",
                      .problem = "a run with one train at each position does not count trains",
                      .allowed = "with pulse.trains = \"many\""});
  return problem;
}

output::Schedule pulse_schedule(const Scenario& s, const pulse::Problem& problem) {
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

namespace {

/// The default spacing in widths of a dislocation where they are narrowest: by the contact ratio, or packed densely.
double chosen_spacing(const Scenario& s, double left, double right) {
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
void require_sites(const Scenario& s, const chain::ScaledProblem& c) {
  constexpr double fewest = 8;
  const double sites = std::ceil(c.scale * (c.right - c.left) / c.spacing - 1e-9) + (c.boundary.periodic ? 0 : 1);
  if (!(sites < fewest)) return;
  const bool by_spacing = s.chain.spacing && !s.chain.scale;
  throw InputError(
      {.file = s.file,
       .key = by_spacing ? "chain.spacing" : "chain.scale",
       .value = by_spacing ? s.in_results(c.spacing, "b / A") : digits(c.scale),
       .problem = "makes a chain of " + digits(sites) + " sites, " + s.in_results(c.spacing, "b / A") + " apart",
       .allowed = "at least 8 sites: a larger scale or domain, or a smaller chain.spacing"});
}

void require_fronts(const Scenario& s, const chain::ScaledProblem& c) {
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
double spacing_of(const Scenario& s, double left, double right) {
  if (s.chain.spacing) return *s.chain.spacing;
  if (s.chain.model != chain::Model::lattice) return chosen_spacing(s, left, right);
  if (s.medium.contact_ratio) return *s.medium.contact_ratio;
  throw InputError({.file = s.file,
                    .key = "chain.spacing",
                    .problem = "a lattice needs its spacing, which is the contact ratio A",
                    .allowed = "[chain] spacing = ... or [medium] contact_ratio = ..."});
}

}  // namespace

chain::ScaledProblem chain_problem(const Scenario& s) {
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
  c.phases_of_32_bits = s.chain.phases_of_32_bits;
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

namespace {

constexpr double pi = std::numbers::pi;

void add_rate_and_state(const Scenario& s, const friction::Friction& friction, double x, Numbers& n) {
  const double f0 = friction.parameter("strength"), a = friction.parameter("direct_effect"),
               b = friction.parameter("evolution_effect"), slip = friction.parameter("characteristic_slip");
  if (a > 0) n.strength_over_direct_effect = f0 / a;
  if (!(b > a && slip > 0)) return;  // steady sliding is stable
  const double v = s.loading.acts() ? s.loading.velocity_of(x) : 0;
  const double critical = (b - a) / slip * (1 + (a > 0 ? v * v / (a * slip) : 0));
  n.critical_stiffness = critical;
  const bool everywhere = s.loading.acts() && s.loading.where == chain::Pulled::everywhere;
  const double stiffness = everywhere ? s.loading.stiffness_of(x) : 0;
  if (everywhere) n.stiffness_ratio = stiffness / critical;
  if (stiffness < critical) n.nucleation_length = 2 * pi / std::sqrt(critical - stiffness);
}

void extend(std::optional<Range>& range, const std::optional<double>& value, double x, double y) {
  if (!value) return;
  const ValueAt there{*value, x, y};
  if (!range) range = {there, there};
  if (*value < range->least.value) range->least = there;
  if (*value > range->largest.value) range->largest = there;
}

/// The numbers of friction at the position with the largest critical stiffness, and their ranges.
Numbers numbers_along(const Scenario& s, const Extent& extent, double ratio) {
  const bool plane = s.plane.has_value();
  const int columns = plane ? 201 : 2001, rows = plane ? 201 : 1;
  Numbers least_stable, ranges;
  for (int i = 0; i < columns * rows; ++i) {
    const int column = i % columns, row = i / columns;
    const double x = extent.left + (extent.right - extent.left) * column / (columns - 1);
    const double y = plane ? extent.bottom + (extent.top - extent.bottom) * row / (rows - 1) : 0;
    Numbers there;
    there.position = x;
    if (plane) there.position_y = y;
    add_rate_and_state(s, s.friction.at(x, y / ratio), x, there);
    extend(ranges.strength_over_direct_effect_range, there.strength_over_direct_effect, x, y);
    extend(ranges.stiffness_ratio_range, there.stiffness_ratio, x, y);
    extend(ranges.nucleation_length_range, there.nucleation_length, x, y);
    if (i == 0 || there.critical_stiffness > least_stable.critical_stiffness) least_stable = there;
  }
  least_stable.strength_over_direct_effect_range = ranges.strength_over_direct_effect_range;
  least_stable.stiffness_ratio_range = ranges.stiffness_ratio_range;
  least_stable.nucleation_length_range = ranges.nucleation_length_range;
  return least_stable;
}

/// The numbers of rate-and-state friction on a line or a plane.
Numbers numbers_of_friction(const Scenario& s, const Extent& extent, double ratio) {
  Numbers n;
  if (s.friction.name() != "rate-and-state") return n;
  if (s.friction.varies() || s.loading.stiffness_at || s.loading.velocity_at) return numbers_along(s, extent, ratio);
  add_rate_and_state(s, s.friction, 0, n);
  return n;
}

}  // namespace

Numbers numbers_of(const Scenario& s) {
  if (s.plane) {
    const plane::Problem& p = s.plane->problem;
    const double ratio = s.plane->wave_speed_ratio;
    return numbers_of_friction(s, {p.left, p.right, p.bottom * ratio, p.top * ratio}, ratio);
  }
  const pulse::Problem problem = stated_problem(s);
  Numbers n = numbers_of_friction(s, {problem.left, problem.right}, 1);
  n.length = problem.right - problem.left;
  if (!s.substrate) return n;
  constexpr int samples = 10000;  // midpoint rule
  double sum = 0;
  for (int i = 0; i < samples; ++i) sum += s.stress(problem.left + *n.length * (i + 0.5) / samples);
  n.dislocations = sum / samples * *n.length / (2 * pi);
  return n;
}

}  // namespace slipfront::scenario
