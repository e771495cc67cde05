#pragma once
/// \file
/// The tables of a scenario on a plane.

#include <string>

#include "scenario/text/section.hpp"
#include "slipfront/scenario/scenario.hpp"

namespace slipfront::scenario {

/// Whether the scenario is on a plane: it has the table [plane].
bool is_plane(const Document& document);

/// On a plane, the coefficient of viscous friction may be a formula of x and y. Takes that formula from the document,
/// where the number 1 replaces it, and returns it; empty if there is none. \throws InputError for a formula of another
/// law.
std::string take_coefficient(Document& document);

/// Reads [plane] and all formulas of x and y, and tries them over the plane. \throws InputError.
void read_plane(const Document& document, const TableReader& tables, const std::string& coefficient,
                Scenario& scenario);

/// Reads the keys of [output] about a plane. \throws InputError for a probe outside the plane.
void read_plane_output(const Document& document, Plane& plane);

}  // namespace slipfront::scenario
