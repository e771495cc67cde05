#pragma once

#include "catalogue/csv/csv_layout.hpp"

namespace slipfront::catalogue {

/// \throws InputError (line, problem, allowed) for a table of the subfaults of one event: slip at positions, with
/// depths, and neither names, dates, magnitudes nor velocities of events.
void refuse_subfaults(const Layout& layout);

}  // namespace slipfront::catalogue
