#include "scenario/friction/friction_units.hpp"

namespace slipfront::scenario {
namespace {

using friction::Dimension;
using friction::Parameter;
constexpr std::string_view normal_stress = "normal_stress";

ModelUnit model_unit(Dimension dimension) {
  switch (dimension) {
    case Dimension::force:
      return ModelUnit::force;
    case Dimension::slip:
      return ModelUnit::slip;
    case Dimension::time:
      return ModelUnit::time;
    case Dimension::velocity:
      return ModelUnit::slip_velocity;
    case Dimension::pressure:
    case Dimension::number:
      break;
  }
  return ModelUnit::none;
}

medium::Dimension kind_of(Dimension dimension) {
  return dimension == Dimension::pressure ? medium::Dimension::pressure : dimension_of(model_unit(dimension));
}

}  // namespace

double FrictionUnits::normal_stress_in_si() {
  const double pressed = friction_.quantity(normal_stress, *friction_.find(normal_stress), medium::Dimension::pressure);
  if (!(pressed > 0)) throw friction_.refuse(normal_stress, "not positive", "> 0");
  return pressed;
}

ModelUnit FrictionUnits::unit_of(const Parameter& p) { return model_unit(p.dimension); }

double FrictionUnits::si_of(const Parameter& p) {
  if (p.dimension == Dimension::pressure) {
    if (!friction_.has(normal_stress))
      throw friction_.refuse(p.name, "in SI units it needs friction.normal_stress",
                             "friction.normal_stress, or a number: a share of the normal stress");
    return normal_stress_in_si();
  }
  return friction_.si(p.name, model_unit(p.dimension));
}

double FrictionUnits::in_model(const Parameter& p) {
  const Value* const value = friction_.find(p.name);
  const bool force = p.dimension == Dimension::force, number = !value || value->kind == Value::Kind::number;
  const bool coefficient = force && number && friction_.has(normal_stress);
  if (value && (p.dimension == Dimension::number || (number && !coefficient))) {
    friction_.check(p.name, *value, {});
    // The coefficient of a power of w has no SI unit, and that of a formula or a file is a factor.
    const bool curve = friction_.has("formula") || friction_.has("file");
    if (!force || (p.unit == friction::force_unit && !curve)) friction_.check_unit(p.name, *value, unit_of(p));
    return value->number;
  }
  if (value && force && p.unit != friction::force_unit)
    throw friction_.refuse(p.name, "a coefficient of a power of w has no SI unit here", "a number in the model's unit");
  if (!number) return friction_.quantity(p.name, *value, kind_of(p.dimension)) / si_of(p);
  if (!coefficient || (!value && p.value == 0)) return p.value;
  return (value ? value->number : p.value) * normal_stress_in_si() / si_of(p);
}

}  // namespace slipfront::scenario
