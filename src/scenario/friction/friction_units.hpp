#pragma once

#include <optional>
#include <string>

#include "scenario/text/section.hpp"
#include "slipfront/friction/law.hpp"
#include "slipfront/medium/constants.hpp"

namespace slipfront::scenario {

/// Parameters of friction as a laboratory gives them, in the model's units (docs/friction.md, "In SI units"): a text
/// with a unit, or, where [friction] has a `normal_stress`, forces as friction coefficients.
class FrictionUnits {
 public:
  FrictionUnits(const Section& friction, const medium::Constants& medium) : friction_(friction), medium_(medium) {}

  /// The value of a parameter, or its default, which counts as a friction coefficient where the others do. \throws
  /// InputError that names the key, or the constant of [medium] that it needs.
  double in_model(const friction::Parameter& parameter);
  /// The elastic constants that were assumed, in words; empty if none were.
  const std::string& assumed() const { return assumed_; }

 private:
  double unit_of(const friction::Parameter& parameter);
  double normal_stress_in_si();
  double needed(const std::optional<double>& constant, const char* name, const friction::Parameter& parameter) const;

  const Section& friction_;
  const medium::Constants& medium_;
  std::string assumed_;
};

}  // namespace slipfront::scenario
