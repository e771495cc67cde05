#include "scenario/units/model_units.hpp"

#include <limits>
#include <string>

#include "slipfront/error.hpp"
#include "slipfront/medium/medium.hpp"

namespace slipfront::scenario {

using medium::Dimension;
using enum ModelUnit;

namespace {

bool needs_spacing(ModelUnit unit) {
  return unit == position || unit == time || unit == slip || unit == stiffness || unit == end_stiffness;
}

}  // namespace

Dimension dimension_of(ModelUnit unit) {
  switch (unit) {
    case position:
    case slip:
      return Dimension::length;
    case time:
      return Dimension::time;
    case stress:
    case force:
      return Dimension::pressure;
    case slip_velocity:
      return Dimension::velocity;
    case stiffness:
    case end_stiffness:
      return Dimension::stiffness;
    case none:
      break;
  }
  return Dimension::ratio;
}

double ModelUnits::si(ModelUnit unit) const {
  if (unit == none) return 1;
  if (!known_) return std::numeric_limits<double>::quiet_NaN();
  std::string missing;
  if (!medium_.contact_ratio) missing = "medium.contact_ratio";
  if (needs_spacing(unit) && !medium_.asperity_spacing)
    missing += std::string(missing.empty() ? "" : " and ") + "medium.asperity_spacing";
  if (!missing.empty())
    throw InputError(
        {.problem = "in SI units it needs " + missing, .allowed = missing + ", or a number in the model's unit"});
  const double A = *medium_.contact_ratio, b = medium_.asperity_spacing.value_or(1);
  std::string assumed;
  const medium::Elastic rock = medium::elastic(medium_, {}, &assumed);
  if (!assumed.empty() && unit != position && unit != slip) assumed_ = assumed;
  used_ = true;
  const medium::Units units = medium::units(rock.shear_modulus, rock.speed, A, b);
  const double between_faces = medium::face_factor * units.slip;
  const auto traction = [&] { return medium::traction_unit(rock.shear_modulus, rock.poisson_ratio, A); };
  switch (unit) {
    case position:
      return units.length;
    case time:
      return units.time;
    case stress:
      return units.stress;
    case slip_velocity:
      return units.slip_velocity;
    case force:
      return traction();
    case slip:
      return between_faces;
    case stiffness:
      return traction() / between_faces;
    case end_stiffness:
      return units.stress / between_faces;
    case none:
      break;
  }
  return 1;
}

}  // namespace slipfront::scenario
