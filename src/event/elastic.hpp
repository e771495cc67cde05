#pragma once

#include <string>
#include <vector>

#include "slipfront/event/estimate.hpp"

namespace slipfront::event {

/// Elastic constants of one event, after the defaults have filled the gaps.
struct Elastic {
  double speed;  ///< c, m/s
  double shear_modulus;
  double poisson_ratio;
};

/// Names in `assumed`, if it is given, the defaults that were used. \throws InputError for constants out of range.
Elastic elastic(const medium::Constants& constants, const MediumDefaults& defaults, std::string* assumed = nullptr);

}  // namespace slipfront::event
