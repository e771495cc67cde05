#pragma once

#include <functional>

#include "slipfront/scenario/scenario.hpp"

namespace slipfront::setup {

/// Returns the forcing of a scenario on [left, right], or null if there is none. With `initial.hold` it adds a static
/// load that holds the initial stress at rest: F = g_x with g = (4 / pi) a cosh(psi) E. This load follows from M_t = 2
/// pi (F - g_x), which holds where nothing moves (docs/theory/6_contact.md).
std::function<double(double, double)> forcing_of(const scenario::Scenario& scenario, double left, double right);

}  // namespace slipfront::setup
