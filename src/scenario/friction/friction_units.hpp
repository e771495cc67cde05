#pragma once

#include "scenario/text/section.hpp"
#include "slipfront/friction/law.hpp"

namespace slipfront::scenario {

/// Parameters of friction as a laboratory gives them, in the model's units (docs/friction.md, "In SI units"): a text
/// with a unit, or, where [friction] has a `normal_stress`, forces as friction coefficients.
class FrictionUnits {
 public:
  explicit FrictionUnits(const Section& friction) : friction_(friction) {}

  /// The value of a parameter, or its default, which counts as a friction coefficient where the others do. \throws
  /// InputError that names the key, or the constant of [medium] that it needs.
  double in_model(const friction::Parameter& parameter);
  /// The unit of a parameter; none for a number, a share of the normal stress, and so on.
  static ModelUnit unit_of(const friction::Parameter& parameter);

 private:
  double si_of(const friction::Parameter& parameter);
  double normal_stress_in_si();

  const Section& friction_;
};

}  // namespace slipfront::scenario
