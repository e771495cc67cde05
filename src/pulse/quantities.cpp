#include <cmath>

#include "foundation/math/constants.hpp"
#include "slipfront/pulse/run.hpp"

namespace slipfront::pulse {
namespace {

using Error = ErrorRule;
using output::Value;

/// C of f = C w; NaN for other laws.
double viscous_coefficient(const Run& run) { return run.problem().friction.linear_coefficient().value_or(none); }

constexpr std::string_view not_viscous = "friction is not viscous";
constexpr std::string_view no_crossing =
    "no dislocations have overtaken others, or pulse.trains = \"many\" makes them a train of their own";

constexpr output::Quantity<Report> of_run[] = {
    {{"closure", "how friction is averaged", "", "Eqs. 7"},
     [](const Report& e) -> Value { return name_of(e.run.problem().friction.closure()); },
     output::Kind::text},
    {{"friction_coefficient", "C of viscous friction", "", "Eqs. 7", not_viscous},
     [](const Report& e) -> Value { return viscous_coefficient(e.run); }},
    {{"damping_number", "Gamma = C t of viscous friction", "", "Eqs. 7", not_viscous},
     [](const Report& e) -> Value { return viscous_coefficient(e.run) * e.run.time(); }},
    {{"first_crossing_time", "time at which dislocations first overtake each other", "b / (c A)", "docs/pulse.md",
      no_crossing, Error::change},
     [](const Report& e) -> Value { return e.run.crossing_time(); }},
    {{"first_crossing_position", "x at which they do; averages are approximate behind it", "b / A", "docs/pulse.md",
      no_crossing, Error::position},
     [](const Report& e) -> Value { return e.run.crossing_position(); }},
    {{"conservation_error", "relative error of the number of dislocations", "", "Eq. 7"},
     [](const Report& e) -> Value { return e.run.conservation_error(); }},
    {{"cells", "cells in the domain at t = 0; others come in and leave through its ends", "", ""},
     [](const Report& e) -> Value { return static_cast<long>(e.run.problem().cells); }},
    {output::step_count, [](const Report& e) -> Value { return e.run.steps(); }},
    {{"solve_seconds", "seconds of the time steps only", "", ""},
     [](const Report& e) -> Value { return e.run.stepping_seconds(); },
     output::Kind::of_machine},
    {output::wall_time, [](const Report& e) -> Value { return e.wall; }, output::Kind::of_machine},
};

}  // namespace

std::span<const output::Quantity<Report>> quantities() { return of_run; }

}  // namespace slipfront::pulse
