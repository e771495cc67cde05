#pragma once

#include <vector>

#include "pulse/view/view.hpp"

namespace slipfront::pulse {

/// Whether there is no stress outside an end of a view.
bool free_at(const View& view, bool right);

/// Position of the leading front, on the less stressed side; NaN if there is none. It is the free edge, or the position
/// at which the slip velocity W (of the cells) falls to half of its maximum. The velocity of dislocations would not do:
/// a shock pushes a few dislocations of a dilute train ahead of itself.
double leading_front(const View& view, const std::vector<double>& W, bool to_right);

/// Position of the trailing front, the foot of the fan on the more stressed side; NaN if there is none. We find the
/// first cell whose slip velocity differs from that at the stressed end by a thousandth of the maximum. A parabola
/// through three cells behind it gives x as a function of the difference, and is extrapolated to zero difference.
///
/// Friction can draw the foot out into a tail. The front is then the position at which the difference reaches a
/// thousandth of the maximum. The same holds for a smooth initial stress (`smooth`), whose fan has no corner: whether
/// cells show one would depend on their number.
double trailing_front(const View& view, const std::vector<double>& W, bool stressed_left, bool smooth);

}  // namespace slipfront::pulse
