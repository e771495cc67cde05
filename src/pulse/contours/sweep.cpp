#include <algorithm>
#include <cmath>
#include <numeric>

#include "pulse/contours/contour.hpp"

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

/// Change of a coordinate from point to point along the curve, at one end of a stretch: by central differences, at a
/// corner from one side.
double change_at(const std::vector<double>& f, std::size_t here, std::size_t ahead, std::size_t behind, bool corner,
                 std::size_t after, bool ahead_is_corner) {
  if (!corner && behind != Contour::nothing) return (f[ahead] - f[behind]) / 2;
  if (ahead_is_corner || after == Contour::nothing) return f[ahead] - f[here];
  return 2 * (f[ahead] - f[here]) - (f[after] - f[here]) / 2;
}

/// A coordinate along a curve between a point and the next one, as a cubic function of the number of the point.
Cubic behind(const Contour& c, const std::vector<double>& f, std::size_t a) {
  const std::size_t b = c.next[a], before = c.previous[a], after = c.next[b];
  return {f[a], f[b], change_at(f, a, b, before, c.corner[a], after, c.corner[b]),
          -change_at(f, b, a, after, c.corner[b], before, c.corner[a])};
}

}  // namespace

void Contour::archive(Archive& a) {
  a(x, r, previous, next, corner, front, tip);
  for (const std::size_t each : {r.size(), previous.size(), next.size(), corner.size()}) a.require(each == x.size());
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
  return made;
}

void Contour::remove(std::size_t point) {
  next[previous[point]] = next[point];
  previous[next[point]] = previous[point];
  const std::size_t last = size() - 1;
  if (point != last) {
    x[point] = x[last];
    r[point] = r[last];
    corner[point] = corner[last];
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
