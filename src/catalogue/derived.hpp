#pragma once

#include "slipfront/catalogue/observation.hpp"

namespace slipfront::catalogue {

/// Fills in quantities that follow from others, with a warning for each.
///
/// - slip = moment / (shear_modulus rupture_area), if neither slip nor slip velocity is known. The moment may be that
/// of
///   the moment magnitude, and the area that of length and width.
/// - rupture velocity = rupture_length / duration, if it is not known: an apparent velocity.
///
/// `shear_modulus` in Pa; `speed` c in m/s, which an apparent velocity must not reach.
void derive(Observation& observation, double shear_modulus, double speed);

/// The stress drop of a front in the laboratory from the shear stresses before and after it, if it is not known.
/// \throws InputError if the stress after it is not the smaller one.
void derive_stress_drop(Observation& observation);

}  // namespace slipfront::catalogue
