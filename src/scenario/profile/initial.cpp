#include "scenario/profile/initial.hpp"

#include <cmath>
#include <memory>

#include "foundation/text/digits.hpp"
#include "scenario/formula/formula.hpp"
#include "scenario/profile/monotone.hpp"
#include "scenario/profile/table.hpp"

namespace slipfront::scenario {
namespace {

using Profiles = std::vector<std::pair<std::string_view, ProfileKind>>;

const Profiles& profiles() {
  static const Profiles words = {{"step", ProfileKind::step},
                                 {"tanh", ProfileKind::tanh},
                                 {"formula", ProfileKind::formula},
                                 {"table", ProfileKind::table}};
  return words;
}

std::string profile_name(ProfileKind kind) {
  for (const auto& [name, profile] : profiles())
    if (profile == kind) return std::string(name);
  return {};
}

/// Whether a key of [initial] has a meaning for this profile, and must be there.
enum class Role { none, optional, required };

Role role(std::string_view key, ProfileKind kind) {
  if (key == "formula") return kind == ProfileKind::formula ? Role::required : Role::none;
  if (key == "file") return kind == ProfileKind::table ? Role::required : Role::none;
  if (key == "width") return kind == ProfileKind::tanh ? Role::optional : Role::none;
  return kind == ProfileKind::step || kind == ProfileKind::tanh ? Role::required : Role::none;
}

double read_stress(const Section& section, std::string_view key) {
  const double stress = *section.number(key);
  if (stress > 0 && stress < smallest_stress)
    throw section.refuse(key, "no double holds the state of so small a stress",
                         "0 (empty), or " + shortest(smallest_stress) + " to " + shortest(largest_stress));
  return stress;
}

RawStress from_table(const Section& section, const TableReader& tables) {
  const Column place{"x", {.least = -farthest, .most = farthest}, section.in_file(ModelUnit::position)};
  const Column stress{"stress", {.least = 0, .most = largest_stress}, section.in_file(ModelUnit::stress)};
  const auto curve = std::make_shared<const MonotoneCurve>(read_rows(section, tables, place, stress));
  const Complaint where = section.where("file");
  const auto at = [curve, where](double x) {
    if (x >= curve->first() && x <= curve->last()) return (*curve)(x);
    Complaint complaint = where;
    complaint.problem = "the table does not cover x = " + shortest(x);
    complaint.allowed = shortest(curve->first()) + " <= x <= " + shortest(curve->last());
    throw InputError(complaint);
  };
  return {.at = at, .where = where, .covers = std::pair(curve->first(), curve->last())};
}

RawStress from_formula(const Section& section, const Initial& initial) {
  const Complaint where = section.where("formula");
  const double length = section.in_file(ModelUnit::position), stress = section.in_file(ModelUnit::stress);
  try {
    return {.at = [formula = Formula(initial.formula, {"x"}), length,
                   stress](double x) { return formula(x * length) / stress; },
            .where = where};
  } catch (const InputError& error) {
    throw section.refuse("formula", error.complaint().problem, error.complaint().allowed);
  }
}

}  // namespace

RawStress read_initial(const Document& document, const TableReader& tables, Initial& initial) {
  const Section section(document, "initial");
  if (document.tables.count("initial") == 0)
    throw InputError({.file = document.file,
                      .problem = "there is no [initial] table",
                      .allowed = "[initial] with profile, stress_left, stress_right, ..."});
  initial.profile = section.choice("profile", profiles()).value_or(initial.profile);
  const std::string profile = "profile = \"" + profile_name(initial.profile) + "\"";
  for (const std::string_view key : {"stress_left", "stress_right", "width", "file", "formula"}) {
    const Role wanted = role(key, initial.profile);
    if (section.has(key) && wanted == Role::none)
      throw section.refuse(key, "does not fit " + profile, "leave it out, or change initial.profile");
    if (!section.has(key) && wanted == Role::required) throw section.refuse(key, "missing", profile + " needs it");
  }
  if (section.in_si() && initial.profile != ProfileKind::formula && initial.profile != ProfileKind::table)
    throw section.refuse("units", "concerns formula and file only",
                         "texts with units, such as stress_left = \"3 MPa\"");
  initial.hold = section.truth("hold").value_or(initial.hold);
  initial.even_ends = initial.profile == ProfileKind::step || initial.profile == ProfileKind::tanh;
  initial.jumps = initial.profile == ProfileKind::step;
  if (initial.profile == ProfileKind::formula) {
    initial.formula = *section.formula("formula");
    return from_formula(section, initial);
  }
  if (initial.profile == ProfileKind::table) {
    initial.file = *section.text("file");
    return from_table(section, tables);
  }
  const double left = initial.stress_left = read_stress(section, "stress_left");
  const double right = initial.stress_right = read_stress(section, "stress_right");
  const Complaint where = section.where("profile");
  if (initial.hold && initial.profile == ProfileKind::step && left != right)
    throw section.refuse("hold", "no load holds a step of stress", "with a smooth profile, such as \"tanh\"");
  if (initial.profile == ProfileKind::step)
    return {.at = [left, right](double x) { return x < 0 ? left : right; }, .where = where};
  const double width = initial.width = section.number("width").value_or(initial.width);
  initial.reach = 5 * width;
  return {.at = [=](double x) { return right + (left - right) * (1 - std::tanh(x / width)) / 2; }, .where = where};
}

}  // namespace slipfront::scenario
