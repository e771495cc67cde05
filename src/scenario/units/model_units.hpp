#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "slipfront/medium/constants.hpp"
#include "slipfront/scenario/keys.hpp"

namespace slipfront::scenario {

/// The units of the model in SI units, which follow from the constants of [medium]. Slip, slip velocity and stretch of
/// springs are between the faces, because both move (medium::face_factor).
class ModelUnits {
 public:
  ModelUnits() = default;
  /// If not all constants could be read, `known` is false and every unit is NaN: the file has another error then.
  ModelUnits(const medium::Constants& medium, bool known) : medium_(medium), known_(known) {}

  /// The value of one unit of the model. \throws InputError (problem and allowed only) that names the constants of
  /// [medium] which are missing.
  double si(ModelUnit unit) const;
  /// The elastic constants that were assumed so far, in words; empty if none were.
  const std::string& assumed() const { return assumed_; }
  /// Whether a value was converted.
  bool used() const { return used_; }

 private:
  medium::Constants medium_;
  bool known_ = true;
  mutable std::string assumed_;
  mutable bool used_ = false;
};

/// The SI dimension of a unit of the model.
medium::Dimension dimension_of(ModelUnit unit);

}  // namespace slipfront::scenario
