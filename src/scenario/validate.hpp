#pragma once

#include "scenario/profile/initial.hpp"

namespace slipfront::scenario {

/// Fills scenario.stress, forcing_at and contact_at with functions that check what they return, tries them over the
/// domain, and warns of stress too small to be held. \throws InputError for a sample that is not allowed.
void make_functions(const Document& document, const RawStress& raw, Scenario& scenario);

}  // namespace slipfront::scenario
