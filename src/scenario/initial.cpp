// The table [initial] of a scenario on a line, and the functions of x that its tables give.

#include <algorithm>
#include <cmath>
#include <memory>
#include <vector>

#include "math/digits.hpp"
#include "scenario/formula.hpp"
#include "scenario/functions.hpp"
#include "scenario/readers.hpp"

namespace slipfront::scenario {

namespace {

/// Whether a key of [initial] has a meaning for this profile, and must be there.
enum class Role { none, optional, required };

Role role(std::string_view key, ProfileKind kind) {
  const bool sides = kind == ProfileKind::step || kind == ProfileKind::tanh;
  if (key == "formula") return kind == ProfileKind::formula ? Role::required : Role::none;
  if (key == "file") return sides || kind == ProfileKind::formula ? Role::none : Role::required;
  if (key == "width") return kind == ProfileKind::tanh ? Role::optional : Role::none;
  return sides ? Role::required : Role::none;
}

double read_stress(const Section& section, std::string_view key) {
  const double stress = *section.number(key);
  if (stress > 0 && stress < smallest_stress)
    throw section.refuse(key, "no double holds the state of so small a stress",
                         "0 (empty), or " + shortest(smallest_stress) + " to " + shortest(largest_stress));
  return stress;
}

RawStress stress_of_table(const Section& section, const TableReader& tables) {
  const Column place{"x", {.least = -farthest, .most = farthest}, section.in_file(ModelUnit::position)};
  const Column stress{"stress", {.least = 0, .most = largest_stress}, section.in_file(ModelUnit::stress)};
  const auto curve = std::make_shared<const MonotoneCurve>(TableFile(section, tables).rows(place, stress));
  const Complaint where = section.where("file");
  const auto at = [curve, where](double x) {
    if (x >= curve->first() && x <= curve->last()) return (*curve)(x);
    throw refused_at(where, "the table does not cover x = " + shortest(x),
                     shortest(curve->first()) + " <= x <= " + shortest(curve->last()));
  };
  return {.at = at, .where = where, .covers = std::pair(curve->first(), curve->last())};
}

}  // namespace

void read_profile(const Section& section, bool on_plane, Initial& initial) {
  section.read("profile", initial.profile);
  const std::string profile =
      "profile = \"" + std::string(section.key("profile").words[static_cast<std::size_t>(initial.profile)]) + '"';
  const bool of_plane = initial.profile == ProfileKind::radial || initial.profile == ProfileKind::grid;
  if (on_plane && !of_plane && initial.profile != ProfileKind::formula)
    throw section.refuse("profile", section.has("profile") ? "does not fit [plane]" : "missing",
                         "formula, radial, grid");
  if (!on_plane && of_plane)
    throw section.refuse("profile", "is of a plane", "step, tanh, formula, table, or with [plane]");
  for (const std::string_view key : {"stress_left", "stress_right", "width", "file", "formula"}) {
    const Role wanted = role(key, initial.profile);
    if (section.has(key) && wanted == Role::none)
      throw section.refuse(key, "does not fit " + profile, "leave it out, or change initial.profile");
    if (!section.has(key) && wanted == Role::required) throw section.refuse(key, "missing", profile + " needs it");
  }
  section.read("hold", initial.hold);
  section.read("file", initial.file);
}

RawStress read_initial(const Document& document, const TableReader& tables, Initial& initial) {
  const Section section(document, "initial");
  if (document.tables.count("initial") == 0)
    throw InputError({.file = document.file,
                      .problem = "there is no [initial] table",
                      .allowed = "[initial] with profile, stress_left, stress_right, ..."});
  read_profile(section, false, initial);
  if (section.in_si() && initial.profile != ProfileKind::formula && initial.profile != ProfileKind::table)
    throw section.refuse("units", "concerns formula and file only",
                         "texts with units, such as stress_left = \"3 MPa\"");
  initial.even_ends = initial.profile == ProfileKind::step || initial.profile == ProfileKind::tanh;
  initial.jumps = initial.profile == ProfileKind::step;
  if (initial.profile == ProfileKind::formula) {
    initial.formula = *section.formula("formula");
    const double length = section.in_file(ModelUnit::position), stress = section.in_file(ModelUnit::stress);
    return {.at = [formula = compiled(section, "formula", initial.formula, {"x"}), length,
                   stress](double x) { return formula(x * length) / stress; },
            .where = section.where("formula")};
  }
  if (initial.profile == ProfileKind::table) return stress_of_table(section, tables);
  const double left = initial.stress_left = read_stress(section, "stress_left");
  const double right = initial.stress_right = read_stress(section, "stress_right");
  const Complaint where = section.where("profile");
  if (initial.hold && initial.profile == ProfileKind::step && left != right)
    throw section.refuse("hold", "no load holds a step of stress", "with a smooth profile, such as \"tanh\"");
  if (initial.profile == ProfileKind::step)
    return {.at = [left, right](double x) { return x < 0 ? left : right; }, .where = where};
  section.read("width", initial.width);
  const double width = initial.width;
  initial.reach = 5 * width;
  return {.at = [=](double x) { return right + (left - right) * (1 - std::tanh(x / width)) / 2; }, .where = where};
}

namespace {

/// The initial stress, checked at each call. It is 0 if a double cannot hold the state, because dislocations would be
/// too far apart in units of their width 1 / a.
std::function<double(double)> validated_stress(const RawStress& raw, const std::function<double(double)>& contact) {
  return [raw, contact](double x) {
    const double stress = raw.at(x);
    if (!(stress >= 0 && stress <= largest_stress))
      throw refused_at(raw.where, "the stress is " + shortest(stress) + " at x = " + shortest(x),
                       "0 (empty), or " + shortest(smallest_stress) + " to " + shortest(largest_stress));
    const bool vanishes = stress < smallest_stress || (contact && stress < smallest_stress * contact(x));
    return vanishes ? 0.0 : stress;
  };
}

void make_forcing(const Document& document, Scenario& scenario) {
  const Section section(document, "forcing");
  if (!section.has("formula")) return;
  scenario.forcing = *section.formula("formula");
  const CheckedFormula forcing = read_forcing(section, {"x", "t"}, 1);
  scenario.steady_forcing = !forcing.has("t");
  scenario.forcing_at = [forcing](double x, double t) { return forcing(x, 0, t); };
}

void make_contact(const Document& document, Scenario& scenario) {
  const Section section(document, "interface");
  if (!section.has("contact")) return;
  scenario.contact = *section.formula("contact");
  scenario.substrate = scenario.contact != "0";
  if (!scenario.substrate) return;
  scenario.contact_at = [contact = read_contact(section, {"x"}, 1)](double x) { return contact(x, 0); };
}

/// Ageing contacts and pore pressure change the contact ratio at t = 0 from the value in [interface].
void add_contacts_at_start(Scenario& scenario) {
  if (!scenario.friction.changes_contacts() || !scenario.substrate) return;
  const double uniform = scenario.friction.contact_at_start(0);
  scenario.contact_at = [uniform, friction = scenario.friction, given = scenario.contact_at](double x) {
    return (friction.varies() ? friction.contact_at_start(x) : uniform) * (given ? given(x) : 1.0);
  };
}

/// The largest friction force at rest or nearly at rest. It is the greatest of three values: the strength at rest at
/// t = 0, the nominal strength of the law, and the peak of a force that falls again at higher speeds. We do not search
/// a curve for a peak, because a table may end.
double holding_force(const friction::Friction& friction) {
  double held = std::fmax(friction.strength_at_rest(), friction.parameter("strength"));
  if (friction.definition().curve != friction::CurveSource::none) return held;
  const std::vector<double> state = friction.state_at_start();
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

void try_functions(const Document& document, const RawStress& raw, Scenario& scenario) {
  constexpr int samples = 2001;
  const auto [left, right] = trial_range(scenario.domain, scenario.initial.reach, raw.covers);
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
    throw refused_at(Section(document, "interface").where("contact"),
                     quantity + " is below " + shortest(smallest_stress) + " everywhere",
                     "at least " + shortest(smallest_stress) + " somewhere");
  if (first_small)
    scenario.warnings.push_back(quantity + " between 0 and " + shortest(smallest_stress) +
                                " counts as 0, because a double cannot hold its state: first at x = " +
                                shortest(*first_small) + ", last at x = " + shortest(last_small));
}

}  // namespace

std::pair<double, double> trial_range(const Domain& domain, double reach,
                                      const std::optional<std::pair<double, double>>& covers) {
  const double far = reach > 0 ? 2 * reach : 7;
  const auto [left, right] = covers.value_or(std::pair(-far, far));
  if (domain.left && domain.right) return {*domain.left, *domain.right};
  if (domain.left) return {*domain.left, std::max(right, *domain.left + (covers ? 0 : 2 * far))};
  if (domain.right) return {std::min(left, *domain.right - (covers ? 0 : 2 * far)), *domain.right};
  return {left, right};
}

void make_functions(const Document& document, const RawStress& raw, Scenario& scenario) {
  make_forcing(document, scenario);
  make_contact(document, scenario);
  add_contacts_at_start(scenario);
  if (!scenario.substrate &&
      (scenario.initial.profile == ProfileKind::formula || scenario.initial.profile == ProfileKind::table ||
       scenario.initial.stress_left > 0 || scenario.initial.stress_right > 0))
    throw refused_at(Section(document, "interface").where("contact"),
                     "without a substrate there are no dislocations, and so no initial stress",
                     "with initial.stress_left = 0 and stress_right = 0, or a contact > 0");
  scenario.stress = validated_stress(raw, scenario.contact_at);
  try_functions(document, raw, scenario);
}

}  // namespace slipfront::scenario
