#include "scenario/friction/friction_units.hpp"

#include "scenario/text/quantity_value.hpp"
#include "slipfront/medium/constants.hpp"
#include "slipfront/medium/medium.hpp"

namespace slipfront::scenario {
namespace {

using friction::Dimension;
using friction::Parameter;
constexpr std::string_view normal_stress = "normal_stress";

medium::Dimension kind_of(Dimension dimension) {
  switch (dimension) {
    case Dimension::force:
    case Dimension::pressure:
      return medium::Dimension::pressure;
    case Dimension::slip:
      return medium::Dimension::length;
    case Dimension::time:
      return medium::Dimension::time;
    case Dimension::velocity:
      return medium::Dimension::velocity;
    case Dimension::number:
      break;
  }
  return medium::Dimension::ratio;
}

}  // namespace

double FrictionUnits::needed(const std::optional<double>& constant, const char* name,
                             const Parameter& parameter) const {
  if (constant) return *constant;
  throw friction_.refuse(parameter.name, std::string("in SI units it needs medium.") + name,
                         std::string("medium.") + name + ", or a number in the model's unit");
}

double FrictionUnits::normal_stress_in_si() {
  const double pressed =
      quantity_in(friction_, normal_stress, *friction_.find(normal_stress), medium::Dimension::pressure);
  if (!(pressed > 0)) throw friction_.refuse(normal_stress, "not positive", "> 0");
  return pressed;
}

double FrictionUnits::unit_of(const Parameter& p) {
  if (p.dimension == Dimension::pressure) {
    if (!friction_.has(normal_stress))
      throw friction_.refuse(p.name, "in SI units it needs friction.normal_stress",
                             "friction.normal_stress, or a number: a share of the normal stress");
    return normal_stress_in_si();
  }
  std::string assumed;
  const medium::Elastic rock = medium::elastic(medium_, {}, &assumed);
  if (!assumed.empty()) assumed_ = assumed;
  const double A = needed(medium_.contact_ratio, "contact_ratio", p);
  if (p.dimension == Dimension::force) return medium::traction_unit(rock.shear_modulus, rock.poisson_ratio, A);
  if (p.dimension == Dimension::velocity) return medium::slip_velocity_unit(rock.speed, A);
  const double b = needed(medium_.asperity_spacing, "asperity_spacing", p);
  const medium::Units units = medium::units(rock.shear_modulus, rock.speed, A, b);
  // Laboratories measure slip between the faces, as slip velocity: both move.
  return p.dimension == Dimension::slip ? medium::face_factor * units.slip : units.time;
}

double FrictionUnits::in_model(const Parameter& p) {
  const Value* const value = friction_.find(p.name);
  const bool force = p.dimension == Dimension::force, number = !value || value->kind == Value::Kind::number;
  const bool coefficient = force && number && friction_.has(normal_stress);
  if (value && (p.dimension == Dimension::number || (number && !coefficient))) {
    friction_.check(p.name, *value, {});
    return value->number;
  }
  if (value && force && p.unit != friction::force_unit)
    throw friction_.refuse(p.name, "a coefficient of a power of w has no SI unit here", "a number in the model's unit");
  if (!number) return quantity_in(friction_, p.name, *value, kind_of(p.dimension)) / unit_of(p);
  if (!coefficient || (!value && p.value == 0)) return p.value;
  return (value ? value->number : p.value) * normal_stress_in_si() / unit_of(p);
}

}  // namespace slipfront::scenario
