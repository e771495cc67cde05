#include "slipfront/output/slip_event.hpp"

namespace slipfront::output {
namespace {

constexpr SlipEventColumn columns[] = {
    {{"onset", "time at which the slip velocity of a part of the chain rises above the threshold", "b / (c A)",
      "Eq. 1"},
     &SlipEvent::onset},
    {{"duration", "time until all parts are below half the threshold", "b / (c A)", "Eq. 1"}, &SlipEvent::duration},
    {{"slip", "slip, mean over the chain", "b / (2 pi)", "Eq. 1"}, &SlipEvent::slip},
    {{"largest_slip", "slip of the part that slips most", "b / (2 pi)", "Eq. 1"}, &SlipEvent::largest_slip},
    {{"stress_drop", "fall of the mean force F on a site, or of the stress at a pulled end",
      "mu A^2 / (pi (1 - nu)); mu A / pi at an end", "Eq. 1"},
     &SlipEvent::stress_drop},
    {{"peak_velocity", "greatest slip velocity of a part", "c A / pi", "Eq. 1"}, &SlipEvent::peak_velocity},
    {{"origin", "position of the part that moves first", "b / A", "Eq. 1"}, &SlipEvent::origin},
    {{"length", "length of the parts that move", "b / A", "Eq. 1"}, &SlipEvent::length},
    {{"rupture_velocity", "velocity of the front, fitted over the parts that move", "c", "Eq. 1"},
     &SlipEvent::rupture_velocity},
    {{"complete", "1, or 0 if the run ended within the event", "", "Eq. 1"}, &SlipEvent::complete},
};

}  // namespace

std::span<const SlipEventColumn> slip_event_columns() { return columns; }

}  // namespace slipfront::output
