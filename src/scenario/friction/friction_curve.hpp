#pragma once

#include "scenario/text/section.hpp"
#include "slipfront/friction/law.hpp"
#include "slipfront/scenario/scenario.hpp"

namespace slipfront::scenario {

/// The curve f(w) that [friction] gives: by a formula, or by a table in a file. Null for laws that take none.
/// \throws InputError where it is no force at the speeds tried; the curve itself throws it at speeds found later.
friction::Curve read_curve(const Section& section, const TableReader& tables, friction::CurveSource source);

}  // namespace slipfront::scenario
