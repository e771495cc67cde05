#pragma once

#include <vector>

#include "pulse/view/view.hpp"

namespace slipfront::pulse {

/// Whether there is no stress outside an end of a view.
bool free_at(const View& view, bool right);

/// The edge of what moves on the less stressed side: the free edge, or where the slip velocity W (of the cells) falls
/// through half of its largest. Velocities of the dislocations would not do: a shock pushes a few of a dilute train
/// ahead of itself.
double leading_front(const View& view, const std::vector<double>& W, bool to_right);

/// The foot of the fan on the more stressed side: behind the first cell whose slip velocity differs from that at the
/// stressed end by a thousandth of the largest, the places of three cells as a parabola in that difference,
/// continued to none. Where friction has drawn the foot out into a tail, the front is where the tail is felt, and so it
/// is for a smooth initial stress, whose fan has no corner: whether cells show one would depend on their number.
double trailing_front(const View& view, const std::vector<double>& W, bool stressed_left, bool smooth);

}  // namespace slipfront::pulse
