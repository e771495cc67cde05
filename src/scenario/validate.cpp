#include "scenario/validate.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "foundation/text/digits.hpp"
#include "scenario/formula/formula.hpp"

namespace slipfront::scenario {
namespace {

constexpr int samples = 2001;

InputError refusal(Complaint where, const std::string& problem, const std::string& allowed) {
  where.problem = problem;
  where.allowed = allowed;
  return InputError(std::move(where));
}

/// The initial stress, checked at each call. It is 0 if a double cannot hold the state, because dislocations would be
/// too far apart in units of their width 1 / a.
std::function<double(double)> validated_stress(const RawStress& raw, const std::function<double(double)>& contact) {
  return [raw, contact](double x) {
    const double stress = raw.at(x);
    if (!(stress >= 0 && stress <= largest_stress))
      throw refusal(raw.where, "the stress is " + shortest(stress) + " at x = " + shortest(x),
                    "0 (empty), or " + shortest(smallest_stress) + " to " + shortest(largest_stress));
    const bool vanishes = stress < smallest_stress || (contact && stress < smallest_stress * contact(x));
    return vanishes ? 0.0 : stress;
  };
}

/// Reads a formula. Returns it with its file, line and key, for later error messages.
std::pair<Formula, Complaint> read_formula(const Section& section, std::string_view key, const std::string& text,
                                           const std::vector<std::string_view>& variables) {
  try {
    return {Formula(text, variables), section.where(key)};
  } catch (const InputError& error) {
    throw section.refuse(key, error.complaint().problem, error.complaint().allowed);
  }
}

void make_forcing(const Document& document, Scenario& scenario) {
  const Section section(document, "forcing");
  const auto text = section.formula("formula");
  if (!text) return;
  scenario.forcing = *text;
  auto formula = read_formula(section, "formula", *text, {"x", "t"});
  scenario.steady_forcing = !formula.first.has("t");
  const double length = section.in_file(ModelUnit::position), time = section.in_file(ModelUnit::time),
               unit = section.in_file(ModelUnit::force);
  scenario.forcing_at = [read = std::move(formula), length, time, unit](double x, double t) {
    const double force = read.first(x * length, t * time) / unit;
    if (!std::isfinite(force))
      throw refusal(read.second,
                    "the forcing is " + shortest(force) + " at x = " + shortest(x) + ", t = " + shortest(t),
                    "a finite number");
    return force;
  };
}

void make_contact(const Document& document, Scenario& scenario) {
  const Section section(document, "interface");
  const auto text = section.formula("contact");
  if (!text) return;
  scenario.contact = *text;
  if (*text == "0") {
    scenario.substrate = false;
    return;
  }
  const double length = section.in_file(ModelUnit::position);
  scenario.contact_at = [read = read_formula(section, "contact", *text, {"x"}), length](double x) {
    const double contact = read.first(x * length);
    if (!(contact > 0 && std::isfinite(contact)))
      throw refusal(read.second, "the contact ratio is " + shortest(contact) + " at x = " + shortest(x),
                    "a finite number > 0");
    return contact;
  };
}

/// Ageing contacts and pore pressure change the contact ratio at t = 0 from the value in [interface].
void add_contacts_at_start(Scenario& scenario) {
  if (!scenario.friction.changes_contacts() || !scenario.substrate) return;
  const double at_start = scenario.friction.contact_at_start();
  scenario.contact_at = [at_start, given = scenario.contact_at](double x) {
    return at_start * (given ? given(x) : 1.0);
  };
}

/// The largest friction force at rest or nearly at rest. It is the greatest of three values: the strength at rest at
/// t = 0, the nominal strength of the law, and the peak of a force that falls again at higher speeds. We do not search
/// a curve for a peak, because a table may end.
double holding_force(const friction::Friction& friction) {
  double held = std::fmax(friction.strength_at_rest(), friction.parameter("strength"));
  if (friction.definition().curve != friction::CurveSource::none) return held;
  std::vector<double> state(friction.state_size());
  friction.evolution().start(state);
  double top = 0;
  constexpr double slowest = 1e-12, fastest = 10;
  constexpr int steps = 120;
  for (int i = 0; i <= steps; ++i) {
    const double speed = slowest * std::pow(fastest / slowest, static_cast<double>(i) / steps);
    const double force = friction.law().strength(speed, state);
    if (force < (1 - 1e-9) * top) held = std::fmax(held, top);
    top = std::fmax(top, force);
  }
  return held;
}

/// The contacts of the substrate hold the force a^2 at most, Eq. 3. Friction acts in addition to them.
void warn_of_strength(double largest_contact, Scenario& scenario) {
  const double held = holding_force(scenario.friction), substrate = largest_contact * largest_contact;
  if (!scenario.substrate || !(held > substrate)) return;
  scenario.warnings.push_back("friction holds a force of " + digits(held, 3) + " in the unit of F, " +
                              digits(held / substrate, 3) +
                              " times the most that the contacts of the substrate hold (" + digits(substrate, 3) +
                              "); friction acts in addition to these contacts (docs/friction.md, In SI units)");
}

/// The range of x in which to try the functions: the domain, or an estimate of the domain that a solver will choose.
std::pair<double, double> trial_range(const Scenario& scenario, const RawStress& raw) {
  const double reach = scenario.initial.reach > 0 ? 2 * scenario.initial.reach : 7;
  const auto [left, right] = raw.covers.value_or(std::pair(-reach, reach));
  const Domain& domain = scenario.domain;
  if (domain.left && domain.right) return {*domain.left, *domain.right};
  if (domain.left) return {*domain.left, std::max(right, *domain.left + (raw.covers ? 0 : 2 * reach))};
  if (domain.right) return {std::min(left, *domain.right - (raw.covers ? 0 : 2 * reach)), *domain.right};
  return {left, right};
}

void try_out(const Document& document, const RawStress& raw, Scenario& scenario) {
  const auto [left, right] = trial_range(scenario, raw);
  std::optional<double> first_small;
  double last_small = 0, largest_contact = 1;
  bool stressed = false;
  for (int i = 0; i < samples; ++i) {
    const double x = i == samples - 1 ? right : std::min(right, left + (right - left) * (i / (samples - 1.0)));
    if (scenario.stress(x) > 0) {
      stressed = true;
    } else if (raw.at(x) > 0) {
      first_small = first_small.value_or(x);
      last_small = x;
    }
    if (scenario.contact_at) largest_contact = std::fmax(i == 0 ? 0 : largest_contact, scenario.contact_at(x));
    if (scenario.forcing_at) {
      scenario.forcing_at(x, 0);
      scenario.forcing_at(x, scenario.end);
    }
  }
  warn_of_strength(largest_contact, scenario);
  const std::string quantity = scenario.contact_at ? "initial stress over contact ratio" : "initial stress";
  if (first_small && !stressed && scenario.contact_at)
    throw refusal(Section(document, "interface").where("contact"),
                  quantity + " is below " + shortest(smallest_stress) + " everywhere",
                  "at least " + shortest(smallest_stress) + " somewhere");
  if (first_small)
    scenario.warnings.push_back(quantity + " between 0 and " + shortest(smallest_stress) +
                                " counts as 0, because a double cannot hold its state: first at x = " +
                                shortest(*first_small) + ", last at x = " + shortest(last_small));
}

}  // namespace

void make_functions(const Document& document, const RawStress& raw, Scenario& scenario) {
  make_forcing(document, scenario);
  make_contact(document, scenario);
  add_contacts_at_start(scenario);
  if (!scenario.substrate &&
      (scenario.initial.profile == ProfileKind::formula || scenario.initial.profile == ProfileKind::table ||
       scenario.initial.stress_left > 0 || scenario.initial.stress_right > 0))
    throw refusal(Section(document, "interface").where("contact"),
                  "without a substrate there are no dislocations, and so no initial stress",
                  "with initial.stress_left = 0 and stress_right = 0, or a contact > 0");
  scenario.stress = validated_stress(raw, scenario.contact_at);
  try_out(document, raw, scenario);
}

}  // namespace slipfront::scenario
