#pragma once

#include <functional>

#include "slipfront/scenario/scenario.hpp"

namespace slipfront::setup {

/// The forcing of a scenario on [left, right], and with `initial.hold` the static load beside it that keeps the initial
/// stress at rest: F = g_x, g = (4 / pi) a cosh(psi) E, as M_t = 2 pi (F - g_x) where nothing moves (docs/theory.md 6).
/// Null: none.
std::function<double(double, double)> forcing_of(const scenario::Scenario& scenario, double left, double right);

}  // namespace slipfront::setup
