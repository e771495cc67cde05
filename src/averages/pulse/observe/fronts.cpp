#include "averages/pulse/observe/fronts.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "math/constants.hpp"
#include "math/interpolation.hpp"
#include "slipfront/theory/modulation/modulation.hpp"

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

bool free_at(const View& v, bool right) { return right ? v.right_free : v.left_free; }

namespace {

/// Position of a shock at which W falls in cell `in`, seen from the front. We add up the widths of this cell and up to
/// six cells outwards, each times its slip velocity in units of that behind the shock. The sum is the distance of the
/// shock from the inner face of `in`.
double shock_near(const View& v, const std::vector<double>& W, std::size_t in, bool to_right) {
  constexpr std::size_t behind = 3, beyond = 6;
  const std::size_t n = W.size();
  const auto outward = [&](std::size_t steps) {
    return to_right ? std::min(in + steps, n - 1) : in - std::min(in, steps);
  };
  const std::size_t back = to_right ? in - std::min(in, behind) : std::min(in + behind, n - 1);
  double way = 0;
  std::size_t last = n;
  for (std::size_t j = 0; j <= beyond; ++j) {
    const std::size_t i = outward(j);
    if (i == last) break;
    last = i;
    way += (v.faces[i + 1] - v.faces[i]) * std::clamp(W[i] / W[back], 0.0, 1.0);
  }
  return to_right ? v.faces[in] + way : v.faces[in + 1] - way;
}

}  // namespace

double leading_front(const View& v, const std::vector<double>& W, bool to_right) {
  const std::size_t n = W.size();
  if (free_at(v, to_right)) return to_right ? v.faces.back() : v.faces.front();
  double half = 0;
  for (const double w : W) half = std::fmax(half, std::fabs(w) / 2);
  for (std::size_t i = 1; i < n && half > 0; ++i) {  // from the front inwards
    const std::size_t out = to_right ? n - i : i - 1, in = to_right ? out - 1 : out + 1;
    const double a = std::fabs(W[in]), b = std::fabs(W[out]);
    if (!(a >= half && b < half)) continue;
    if (v.shocked[in] != 0) return shock_near(v, W, in, to_right);
    return std::lerp(v.centres[in], v.centres[out], (half - a) / (b - a));
  }
  return none;
}

namespace {

/// Slip velocities from the more stressed end inwards, as differences from the value at that end.
struct Inwards {
  const View& v;
  const std::vector<double>& W;
  bool stressed_left;

  std::size_t index(std::size_t i) const { return stressed_left ? i : W.size() - 1 - i; }
  double x(std::size_t i) const { return v.centres[index(i)]; }
  double change(std::size_t i) const { return W[index(i)] - W[index(0)]; }
  /// Position between the centres of the cells i - 1 and i at which the size of the change equals `level`.
  double place(std::size_t i, double level) const {
    const double before = std::fabs(change(i - 1)), after = std::fabs(change(i));
    return std::lerp(x(i - 1), x(i), (level - before) / (after - before));
  }
  /// Like `place`, but for a tail that falls by a factor from cell to cell: the logarithm is nearly linear in x.
  double place_in_tail(std::size_t i, double level) const {
    const double before = std::fabs(change(i - 1)), after = std::fabs(change(i));
    if (!(before > 0) || before * after < 0) return place(i, level);
    return std::lerp(x(i - 1), x(i), std::log(level / before) / std::log(after / before));
  }
};

/// Foot of a fan that rises to `top` within a few cells of `first`. We draw a straight line through its points at a
/// quarter and at three quarters of `top`, which the smeared corners of the fan affect least.
double foot_of_narrow_fan(const Inwards& in, std::size_t first, double top) {
  std::size_t i = first;
  const auto place_of = [&](double level) {
    while (std::fabs(in.change(i)) < level) ++i;
    return in.place(i, level);
  };
  const double quarter = place_of(0.25 * top), three_quarters = place_of(0.75 * top);
  return quarter - (three_quarters - quarter) / 2;
}

}  // namespace

double trailing_front(const View& v, const std::vector<double>& W, bool stressed_left, bool smooth) {
  constexpr double felt = 1e-3;
  constexpr std::size_t behind = 4, apart = 3, last = behind + 2 * apart;  // a fan's corner is smeared over 2 cells
  const std::size_t n = W.size();
  if (free_at(v, !stressed_left)) return none;
  const Inwards in{v, W, stressed_left};
  double most = 0;
  for (const double w : W) most = std::fmax(most, std::fabs(w));
  std::size_t first = 0;
  while (first < n && !(std::fabs(in.change(first)) > felt * most)) ++first;
  if (first <= 1 || first + last + behind >= n) return none;  // the front has reached the end, or nothing moves
  if (smooth) return in.place_in_tail(first, felt * most);
  double top = 0;
  for (std::size_t i = first; i <= first + last + behind; ++i) top = std::fmax(top, std::fabs(in.change(i)));
  double x[3], w[3];
  for (std::size_t j = 0; j < 3; ++j) {
    x[j] = in.x(first + behind + apart * j);
    w[j] = in.change(first + behind + apart * j);
  }
  const bool narrow = std::fabs(w[2]) > 0.85 * top && top > 10 * felt * most;
  if (narrow) return foot_of_narrow_fan(in, first, top);
  const bool rises = std::fabs(w[0]) > 0 && w[1] / w[0] > 1.2 && w[2] / w[1] > 1.1;
  const bool tail = w[0] * w[2] > 0.95 * w[1] * w[1];  // an exponential tail, as from a smooth stress, has no foot
  if (!rises || tail) return in.place_in_tail(first, felt * most);
  const auto [slope, curve] = parabola_through(w[1] - w[0], x[1] - x[0], w[2] - w[0], x[2] - x[0]);
  const double foot = x[0] - w[0] * (slope - curve * w[0]);
  const double ahead = in.x(first - 1), farthest = ahead - 2 * (in.x(first) - ahead);
  return std::clamp(foot, std::fmin(farthest, x[0]), std::fmax(farthest, x[0]));
}

}  // namespace slipfront::pulse
