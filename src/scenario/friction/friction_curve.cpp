#include "scenario/friction/friction_curve.hpp"

#include <cmath>
#include <memory>
#include <optional>
#include <utility>

#include "foundation/text/digits.hpp"
#include "scenario/formula/formula.hpp"
#include "scenario/profile/monotone.hpp"
#include "scenario/profile/table.hpp"

namespace slipfront::scenario {
namespace {

InputError refusal(Complaint where, const std::string& problem, const std::string& allowed) {
  where.problem = problem;
  where.allowed = allowed;
  return InputError(std::move(where));
}

/// Tries the curve at velocities that a `chain` or `pulse` run may need. These are rest, and velocities from far below
/// slow slip to far above earthquakes.
void try_out(const Section& section, const friction::Curve& curve, double fastest) {
  const double at_rest = curve(0);
  double greatest = 0;
  constexpr int samples = 320;
  constexpr double slowest = 1e-12;
  for (int i = 0; i <= samples; ++i)
    greatest = std::fmax(greatest, curve(slowest * std::pow(fastest / slowest, static_cast<double>(i) / samples)));
  // A steep law, such as w^0.1, approaches f(0) only at far smaller velocities. A jump remains at any velocity.
  constexpr double nearest_rest = 1e-300;
  const double near_rest = curve(nearest_rest);
  if (std::fabs(near_rest - at_rest) > 1e-3 * greatest)
    throw section.refuse(
        "formula", "f jumps from " + shortest(at_rest) + " at w = 0 to " + shortest(near_rest),
        "f(0) is the force that the interface withstands at rest; for a constant force: law = \"coulomb\"");
}

/// The unit of the model in the unit of the curve. With units = "SI" the curve is in Pa, unless its coefficient is a
/// stress, by its unit or by the normal stress. The curve is then a pure number, as it is in the units of the model.
double force_in_file(const Section& section) {
  const Value* const coefficient = section.find("coefficient");
  const bool stress = section.has("normal_stress") || (coefficient && coefficient->kind == Value::Kind::text);
  return stress ? 1 : section.in_file(ModelUnit::force);
}

friction::Curve from_formula(const Section& section) {
  const std::string text = *section.formula("formula");
  const Complaint where = section.where("formula");
  std::optional<Formula> formula;
  try {
    formula.emplace(text, std::vector<std::string_view>{"w"});
  } catch (const InputError& error) {
    throw section.refuse("formula", error.complaint().problem, error.complaint().allowed);
  }
  const double velocity = section.in_file(ModelUnit::slip_velocity);
  const double force = force_in_file(section);
  friction::Curve curve = [formula = *formula, where, velocity, force](double w) {
    const double f = formula(w * velocity) / force;
    if (!(f >= 0 && std::isfinite(f)))
      throw refusal(where, "the friction is " + shortest(f) + " at the slip velocity w = " + shortest(w),
                    "a finite force >= 0");
    return f;
  };
  try_out(section, curve, 10);
  return curve;
}

friction::Curve from_table(const Section& section, const TableReader& tables) {
  const Column w{"w", {.least = 0, .most = farthest}, section.in_file(ModelUnit::slip_velocity)};
  const Column f{"f", {.least = 0, .most = largest_stress}, force_in_file(section)};
  const auto curve = std::make_shared<const MonotoneCurve>(read_rows(section, tables, w, f));
  if (curve->first() != 0)
    throw section.refuse("file", "the table begins at w = " + shortest(curve->first()),
                         "a first row with w = 0; its f is the force that the interface withstands at rest");
  return [curve, where = section.where("file")](double speed) {
    if (speed <= curve->last()) return (*curve)(speed);
    throw refusal(
        where,
        "the table ends at w = " + shortest(curve->last()) + "; the slip velocity " + shortest(speed) + " was reached",
        "a table up to the slip velocities at the centres of dislocations");
  };
}

}  // namespace

friction::Curve read_curve(const Section& section, const TableReader& tables, friction::CurveSource source) {
  const bool formula = source == friction::CurveSource::formula, table = source == friction::CurveSource::table;
  for (const auto& [key, wanted, law] :
       {std::tuple("formula", formula, "formula"), std::tuple("file", table, "table")}) {
    const std::string with = "with law = \"" + std::string(law) + '"';
    if (section.has(key) && !wanted) throw section.refuse(key, "contradicts friction.law", with);
    if (!section.has(key) && wanted) throw section.refuse(key, "missing", std::string("friction.law needs it"));
  }
  const Value* const coefficient = section.find("coefficient");
  const bool along_plane = coefficient && coefficient->stands_for_formula;
  if (!formula && !table && !along_plane && section.in_si())
    throw section.refuse("units", "concerns formula and file only", "texts with units, such as \"1 um/s\"");
  if (formula) return from_formula(section);
  if (table) return from_table(section, tables);
  return {};
}

}  // namespace slipfront::scenario
