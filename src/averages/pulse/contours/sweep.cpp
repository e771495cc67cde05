#include <algorithm>
#include <cmath>
#include <numeric>

#include "averages/pulse/contours/contour.hpp"

namespace slipfront::pulse {
namespace {

/// Cubic Hermite interpolation on 0 <= s <= 1.
struct Cubic {
  double from, to, slope_from, slope_to;

  double at(double s) const {
    const double t = 1 - s;
    return from * t * t * (1 + 2 * s) + to * s * s * (1 + 2 * t) + s * t * (slope_from * t - slope_to * s);
  }
  double slope(double s) const {
    return 6 * s * (1 - s) * (to - from) + slope_from * (1 - s) * (1 - 3 * s) + slope_to * s * (3 * s - 2);
  }
};

/// Solves for s at which a rising or falling curve has the value `at`, by Newton's method inside a bracket.
double solve_for(const Cubic& curve, double at) {
  const double sign = curve.to > curve.from ? 1 : -1;
  double low = 0, high = 1, s = (at - curve.from) / (curve.to - curve.from);
  constexpr int enough = 60;
  for (int i = 0; i < enough; ++i) {
    const double off = sign * (curve.at(s) - at), slope = sign * curve.slope(s);
    (off > 0 ? high : low) = s;
    double next = s - off / slope;
    if (!(next > low && next < high)) next = (low + high) / 2;
    if (std::fabs(next - s) < 1e-14) return next;
    s = next;
  }
  return s;
}

/// Derivative of the parabola through three values at the first of them, times the distance to the second one.
double change_behind(double here, double ahead, double after, double first, double second) {
  const double share = first / (first + second);
  return (ahead - here) * (1 + share) - (after - ahead) * share * first / second;
}

/// Derivative of the parabola at the second value, times the distance to the third one.
double change_between(double before, double here, double ahead, double first, double second) {
  const double share = first / (first + second);
  return (ahead - here) * share + (here - before) * (1 - share) * second / first;
}

/// A coordinate along a curve between a point and the next one, as a cubic function of the parameter. A curve has no
/// tangent at a corner: there the parabola through the points on one side counts.
Cubic behind(const Contour& c, const std::vector<double>& f, std::size_t a) {
  const std::size_t b = c.next[a], before = c.previous[a], after = c.next[b];
  const double length = c.parameter_behind[a];
  double from = f[b] - f[a], to = from;
  if (before != Contour::nothing && !c.corner[a])
    from = change_between(f[before], f[a], f[b], c.parameter_behind[before], length);
  else if (after != Contour::nothing && !c.corner[b])
    from = change_behind(f[a], f[b], f[after], length, c.parameter_behind[b]);
  if (after != Contour::nothing && !c.corner[b])
    to = -change_between(f[after], f[b], f[a], c.parameter_behind[b], length);
  else if (before != Contour::nothing && !c.corner[a])
    to = -change_behind(f[b], f[a], f[before], length, c.parameter_behind[before]);
  return {f[a], f[b], from, to};
}

}  // namespace

std::vector<std::size_t> Contour::ends(double side) const {
  std::vector<std::size_t> ends;
  for (std::size_t i = 0; i < size(); ++i)
    if (is_end(i) && x[i] * side > 0) ends.push_back(i);
  if (ends.size() != 2) return {};
  if (r[ends[1]] < r[ends[0]]) std::swap(ends[0], ends[1]);
  return ends;
}

void Contour::archive(Archive& a) {
  a(x, r, previous, next, corner, parameter_behind, front, tip);
  for (const std::size_t each : {r.size(), previous.size(), next.size(), corner.size(), parameter_behind.size()})
    a.require(each == x.size());
  const auto exists = [this](std::size_t point) { return point == nothing || point < x.size(); };
  a.require(exists(front) && exists(tip) && std::all_of(previous.begin(), previous.end(), exists) &&
            std::all_of(next.begin(), next.end(), exists));
}

void Contour::add_behind(std::size_t a) { insert_behind(a, behind(*this, x, a).at(0.5), behind(*this, r, a).at(0.5)); }

std::size_t Contour::insert_behind(std::size_t a, double at_x, double at_r) {
  const std::size_t b = next[a], made = size();
  x.push_back(at_x);
  r.push_back(at_r);
  corner.push_back(false);
  previous.push_back(a);
  next.push_back(b);
  next[a] = previous[b] = made;
  parameter_behind[a] /= 2;
  parameter_behind.push_back(parameter_behind[a]);
  return made;
}

void Contour::remove(std::size_t point) {
  parameter_behind[previous[point]] += parameter_behind[point];
  next[previous[point]] = next[point];
  previous[next[point]] = previous[point];
  const std::size_t last = size() - 1;
  if (point != last) {
    x[point] = x[last];
    r[point] = r[last];
    corner[point] = corner[last];
    parameter_behind[point] = parameter_behind[last];
    previous[point] = previous[last];
    next[point] = next[last];
    if (previous[point] != nothing) next[previous[point]] = point;
    if (next[point] != nothing) previous[next[point]] = point;
    for (std::size_t* named : {&front, &tip})
      if (*named == last) *named = point;
  }
  x.pop_back();
  r.pop_back();
  corner.pop_back();
  parameter_behind.pop_back();
  previous.pop_back();
  next.pop_back();
}

/// The rapidity stays in the range of both ends.
double Sweep::rapidity(std::size_t a, double place) const {
  const Contour& c = contour_;
  const std::size_t b = c.next[a];
  if (c.r[a] == c.r[b]) return c.r[a];
  if (c.x[a] == c.x[b]) return (c.r[a] + c.r[b]) / 2;
  const double s = solve_for(behind(c, c.x, a), place);
  const auto [least, most] = std::minmax(c.r[a], c.r[b]);
  return std::clamp(behind(c, c.r, a).at(s), least, most);
}

/// Points at the same x are in the order in which they will move: the faster, the farther to the right.
void Sweep::begin() {
  const Contour& c = contour_;
  const auto before = [&c](std::size_t a, std::size_t b) {
    return c.x[a] != c.x[b] ? c.x[a] < c.x[b] : c.r[a] != c.r[b] ? c.r[a] < c.r[b] : a < b;
  };
  if (order_.size() != c.size()) {
    order_.resize(c.size());
    rank_.resize(c.size());
    std::iota(order_.begin(), order_.end(), 0);
    std::sort(order_.begin(), order_.end(), before);
  }
  for (std::size_t i = 1; i < order_.size(); ++i)  // nearly in order already
    for (std::size_t j = i; j > 0 && before(order_[j], order_[j - 1]); --j) std::swap(order_[j], order_[j - 1]);
  for (std::size_t i = 0; i < order_.size(); ++i) rank_[order_[i]] = i;
  crossed_.clear();
}

void Sweep::end_at(std::size_t point) {
  const auto drop = [&](std::size_t first) { crossed_.erase(std::find(crossed_.begin(), crossed_.end(), first)); };
  if (is_before(contour_.previous[point], point)) drop(contour_.previous[point]);
  if (is_before(contour_.next[point], point)) drop(point);
}

void Sweep::begin_at(std::size_t point) {
  if (is_behind(contour_.previous[point], point)) crossed_.push_back(contour_.previous[point]);
  if (is_behind(contour_.next[point], point)) crossed_.push_back(point);
}

void Sweep::at_points(const VisitPoint& visit) {
  begin();
  const Contour& c = contour_;
  for (const std::size_t point : order_) {
    end_at(point);
    if (!c.is_end(point)) {
      edges_.clear();
      for (const std::size_t first : crossed_) edges_.push_back(rapidity(first, c.x[point]));
      const std::size_t times = is_before(c.previous[point], point) == is_before(c.next[point], point) ? 2 : 1;
      edges_.insert(edges_.end(), times, c.r[point]);
      std::sort(edges_.begin(), edges_.end());
      const auto own = std::lower_bound(edges_.begin(), edges_.end(), c.r[point]);
      visit(point, edges_, static_cast<std::size_t>(own - edges_.begin()));
    }
    begin_at(point);
  }
}

void Sweep::at(std::span<const double> x, const VisitPlace& visit) {
  begin();
  std::size_t passed = 0;
  for (std::size_t i = 0; i < x.size(); ++i) {
    for (; passed < order_.size() && contour_.x[order_[passed]] <= x[i]; ++passed) {
      end_at(order_[passed]);
      begin_at(order_[passed]);
    }
    edges_.clear();
    for (const std::size_t first : crossed_) edges_.push_back(rapidity(first, x[i]));
    std::sort(edges_.begin(), edges_.end());
    visit(i, edges_);
  }
}

}  // namespace slipfront::pulse
