#include "pulse/observe/trailing_characteristic.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "slipfront/modulation/characteristics.hpp"

namespace slipfront::pulse {

/// Part of the change of stress at which the front starts.
constexpr double noticed = 0.01;

TrailingCharacteristic::TrailingCharacteristic(const Solver& start) {
  const View v = start.view();
  const std::size_t n = v.states.size();
  constexpr double rounding = 1e-9;  // if both ends have equal stress, we take the left one on any grid
  // Free edges are tested first: there the stress falls to zero at the face, and not in the last cell.
  const auto is_left = [](double left, double right) { return left >= (1 - rounding) * right; };
  const Problem& p = start.problem();
  stressed_left_ = v.left_free != v.right_free ? v.right_free
                   : v.left_free               ? is_left(p.stress(p.left), p.stress(p.right))
                                               : is_left(v.states.front().psi, v.states.back().psi);
  const auto from_stressed = [&](std::size_t i) { return stressed_left_ ? i : n - 1 - i; };
  const auto stress = [&](double x) { return p.stress(x) / (v.contact ? v.contact(x) : 1); };
  const double end = v.faces[stressed_left_ ? 0 : n];
  const double stressed = stress(std::lerp(end, v.centres[from_stressed(0)], rounding));
  double low = stressed, high = stressed;
  constexpr int samples = 512;  // independent of the number of cells
  for (int i = 0; i < samples; ++i) {
    const double at = stress(std::lerp(v.faces.front(), v.faces.back(), (i + 0.5) / samples));
    low = std::fmin(low, at);
    high = std::fmax(high, at);
  }
  const bool uniform = high - low <= 1e-12 * high;  // uniform up to a free edge, where the front starts
  const auto departs = [&](double x, double share) {
    return !uniform && std::fabs(stress(x) - stressed) > share * (high - low);
  };
  const auto first = [&](double share) {
    std::size_t i = 0;
    while (i < n && !departs(v.centres[from_stressed(i)], share)) ++i;
    return i;
  };
  const std::size_t i = first(noticed);
  position_ = i < n ? v.centres[from_stressed(i)] : v.faces[stressed_left_ ? n : 0];
  double still = i == n ? position_ : i == 0 ? end : v.centres[from_stressed(i - 1)];
  while (true) {
    const double middle = still + (position_ - still) / 2;
    if (middle == still || middle == position_) break;
    (departs(middle, noticed) ? position_ : still) = middle;
  }
  steady_ = first(1e-12) == i && !p.forcing;
  speed_ = steady_ ? speed_into(v.states[from_stressed(0)]) : speed_at(start);
}

double TrailingCharacteristic::speed_into(const State& ahead) const {
  const auto speeds = modulation::characteristic_speeds(ahead);
  return stressed_left_ ? speeds.minus : speeds.plus;
}

/// Speed at the present position. For a smooth stress we interpolate between cells. For a corner we take a cell that is
/// farther ahead than a reconstruction reaches, so that the front itself has no effect.
double TrailingCharacteristic::speed_at(const Solver& now) const {
  const Cells& cells = now.cells();
  const std::size_t last = now.size() - 1;
  std::size_t cell = 0;
  double left = cells.left_edge();
  for (; cell < last && left + cells.width(cell) <= position_; ++cell) left += cells.width(cell);
  if (now.problem().corner < HUGE_VAL) {
    constexpr std::size_t reach = 6;
    return speed_into(now.state_in(stressed_left_ ? cell - std::min(cell, reach) : std::min(cell + reach, last)));
  }
  const double middle = left + cells.width(cell) / 2, here = speed_into(now.state_in(cell));
  const bool to_right = position_ > middle;
  if (to_right ? cell == last : cell == 0) return here;
  const std::size_t next = to_right ? cell + 1 : cell - 1;
  if (cells.charge[cell] == 0 || cells.charge[next] == 0) return here;
  const double apart = (cells.width(cell) + cells.width(next)) / 2;
  return std::lerp(here, speed_into(now.state_in(next)), std::fmin(std::fabs(position_ - middle) / apart, 1.0));
}

void TrailingCharacteristic::advance(const Solver& now, double dt) {
  if (steady_) {
    position_ += dt * speed_;
    return;
  }
  const double before = speed_;
  position_ += dt * before;
  position_ += dt * (speed_at(now) - before) / 2;
  speed_ = speed_at(now);
}

void TrailingCharacteristic::restore(const Solver& now, double position) {
  position_ = position;
  if (!steady_) speed_ = speed_at(now);
}

}  // namespace slipfront::pulse
