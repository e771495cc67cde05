#include "averages/pulse/contours/sweep.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

#include "averages/pulse/contours/contour.hpp"
#include "averages/pulse/contours/many_trains.hpp"
#include "math/constants.hpp"
#include "math/interpolation.hpp"
#include "slipfront/theory/train.hpp"
#include "theory/modulation/equations.hpp"

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

namespace {

void add_points(const Contour& contour, std::vector<double>& x) {
  for (std::size_t i = 0; i < contour.size(); ++i)
    if (!contour.is_end(i)) x.push_back(contour.x[i]);
}

/// Energy density of the train at rest with the same density.
double energy_at_rest(double k) {
  return k >= train::smallest_stress ? train::averages(train::at_rest(k)).H : 4 * k / std::numbers::pi;
}

/// d H / d k of trains at rest: a dislocation has its energy, and does work against the pressure of the others.
double energy_per_density(double k) {
  if (k < train::smallest_stress) return 4 / std::numbers::pi;
  const State at_rest = train::at_rest(k);
  return (train::averages(at_rest).H + modulation::pressure(at_rest.psi)) / k;
}

/// The energies that have come and gone, 0 unless friction or a load acts.
output::Energy energy_of(const Work& work) {
  return {.elastic = 0,
          .kinetic = 0,
          .dissipated = work.dissipated,
          .supplied = work.supplied,
          .through_ends = work.through_ends,
          .shocks = none,
          .residual = work.supplied - work.dissipated + work.through_ends,
          .phonons = none};
}

std::vector<edges::Means> means_at(const Contour& contour, const std::vector<double>& x) {
  std::vector<edges::Means> means(x.size());
  Sweep(contour).at(x, [&](std::size_t i, const std::vector<double>& edges) { means[i] = edges::means_of(edges); });
  return means;
}

}  // namespace

Along::Along(const ManyTrains& trains, const std::vector<double>& x_edges) : trains_(trains) {
  find_nodes(x_edges);
  integrate();
}

void Along::find_nodes(const std::vector<double>& x_edges) {
  nodes_ = {0, trains_.problem().left, trains_.problem().right};
  for (std::size_t i = 0; i < x_edges.size(); ++i) {
    nodes_.push_back(x_edges[i]);
    if (i > 0) nodes_.push_back((x_edges[i - 1] + x_edges[i]) / 2);
  }
  add_points(trains_.start(), nodes_);
  add_points(trains_.contour(), nodes_);
  std::sort(nodes_.begin(), nodes_.end());
  nodes_.erase(std::unique(nodes_.begin(), nodes_.end()), nodes_.end());
}

/// Two-point Gauss rule between the nodes.
void Along::integrate() {
  const std::size_t pieces = nodes_.size() - 1;
  std::vector<double> x(3 * pieces + 1), inside(2 * pieces);  // nodes and Gauss points; Gauss points only
  for (std::size_t i = 0; i < pieces; ++i) {
    const auto [first, second] = gauss_points(nodes_[i], nodes_[i + 1]);
    x[3 * i] = nodes_[i];
    x[3 * i + 1] = inside[2 * i] = first;
    x[3 * i + 2] = inside[2 * i + 1] = second;
  }
  x.back() = nodes_.back();
  const std::vector<edges::Means> now = means_at(trains_.contour(), x), before = means_at(trains_.start(), inside);
  means_.resize(nodes_.size());
  for (std::size_t i = 0; i < nodes_.size(); ++i) {
    means_[i] = now[3 * i];
    if (trains_.time() == 0) means_[i].W = 0;  // at rest, to rounding of the interpolated edges
  }
  energy_ = energy_of(trains_.work());
  stress_.assign(nodes_.size(), 0.0);
  lost_.assign(nodes_.size(), 0.0);
  before_.assign(nodes_.size(), 0.0);
  momentum_.assign(nodes_.size(), 0.0);
  std::vector<double> changed(nodes_.size());
  for (std::size_t i = 0; i < pieces; ++i) {
    const double half = (nodes_[i + 1] - nodes_[i]) / 2;
    stress_[i + 1] = stress_[i];
    lost_[i + 1] = lost_[i];
    before_[i + 1] = before_[i];
    momentum_[i + 1] = momentum_[i];
    changed[i + 1] = changed[i];
    for (std::size_t j = 0; j < 2; ++j) {
      const edges::Means &here = now[3 * i + 1 + j], &first = before[2 * i + j];
      stress_[i + 1] += half * here.k;
      lost_[i + 1] += half * (here.k - first.k);
      before_[i + 1] += half * first.k;
      momentum_[i + 1] += half * here.P;
      changed[i + 1] += half * std::fabs(here.k - first.k);
      add_energy(i, half, here, first);
    }
  }
  spread_uncounted(changed);
}

/// Adds the energy at a Gauss point of the piece behind a node, and its change since t = 0.
void Along::add_energy(std::size_t node, double weight, const edges::Means& now, const edges::Means& first) {
  const bool inside = in_domain(node) && in_domain(node + 1);
  if (inside || !trains_.driven()) energy_.residual -= weight * (now.H - first.H);
  if (!inside) {
    if (!trains_.driven()) energy_.through_ends -= weight * (now.H - first.H);
    return;
  }
  const double at_rest = now.W == 0 ? now.H : energy_at_rest(now.k);
  energy_.elastic += weight * at_rest;
  energy_.kinetic += weight * std::fmax(now.H - at_rest, 0);
  count_ += weight * first.k;
}

/// At the ends of folds, the curves gain or lose some 1e-5 of the dislocations. We spread this over x in proportion to
/// the change of the stress there, so that nothing slips ahead of the fronts, and take its energy away.
void Along::spread_uncounted(const std::vector<double>& changed) {
  const Work& work = trains_.work();
  uncounted_ = lost_.back() - (work.slip_at_left - work.slip_at_right);
  if (!(changed.back() > 0)) return;
  for (std::size_t i = 0; i < lost_.size(); ++i) lost_[i] -= uncounted_ * (changed[i] / changed.back());
  for (std::size_t i = 0; i + 1 < nodes_.size(); ++i) {
    if (!(in_domain(i) && in_domain(i + 1)) || changed[i + 1] == changed[i]) continue;
    const double k = (stress_[i + 1] - stress_[i]) / (nodes_[i + 1] - nodes_[i]);
    const double energy = uncounted_ * ((changed[i + 1] - changed[i]) / changed.back()) * energy_per_density(k);
    energy_.elastic -= energy;
    energy_.residual += energy;
  }
}

double Along::slip(std::size_t node) const { return trains_.work().slip_at_left - lost_[node]; }

std::size_t Along::at(double x) const {
  return static_cast<std::size_t>(std::lower_bound(nodes_.begin(), nodes_.end(), x) - nodes_.begin());
}

bool Along::in_domain(std::size_t node) const {
  return nodes_[node] >= trains_.problem().left && nodes_[node] <= trains_.problem().right;
}

double Along::visible(double x) const { return x >= trains_.problem().left && x <= trains_.problem().right ? x : none; }

double Along::conservation_error() const { return std::fabs(uncounted_) / count_; }

/// The dislocations at x are those that were there at t = 0, less those that have passed.
Counted Along::counted() const {
  Counted all{.x = nodes_, .first = {}, .now = {}, .momentum = momentum_, .density = {}, .momentum_density = {}};
  for (std::size_t i = 0; i < nodes_.size(); ++i) {
    all.first.push_back(before_[i] / (2 * std::numbers::pi));
    all.now.push_back((before_[i] - slip(i)) / (2 * std::numbers::pi));
    all.density.push_back(means_[i].k / (2 * std::numbers::pi));
    all.momentum_density.push_back(means_[i].P);
  }
  return all;
}

output::Profile Along::profile(const std::vector<double>& x_edges) const {
  output::Profile profile;
  for (std::size_t i = 0; i + 1 < x_edges.size(); ++i) {
    const double left = x_edges[i], right = x_edges[i + 1];
    const std::size_t centre = at((left + right) / 2);
    const edges::Means& here = means_[centre];
    const double k = (stress_[at(right)] - stress_[at(left)]) / (right - left);
    profile.k.push_back(k);
    profile.U.push_back(here.k > 0 ? here.W / here.k : 0);
    profile.W.push_back(std::clamp(here.W, -k, k));
    profile.H.push_back(here.H);
    profile.slip.push_back(slip(centre));
    profile.trains.push_back(here.trains);
  }
  return profile;
}

void Along::find_peak(output::Snapshot& s) const {
  const std::size_t n = nodes_.size();
  std::size_t top = n;
  const auto size = [&](std::size_t i) { return std::fabs(means_[i].W); };
  for (std::size_t i = 0; i < n; ++i)
    if (in_domain(i) && (top == n || size(i) > size(top))) top = i;
  s.peak_slip_velocity = means_[top].W;
  s.peak_position = nodes_[top];
  if (top == 0 || top + 1 == n || std::fmin(size(top - 1), size(top + 1)) < 0.9 * size(top)) return;
  const double a = nodes_[top - 1] - nodes_[top], b = nodes_[top + 1] - nodes_[top];
  const auto [slope, curve] =
      parabola_through(a, means_[top - 1].W - means_[top].W, b, means_[top + 1].W - means_[top].W);
  const double best = curve != 0 ? -slope / (2 * curve) : 0;
  if (!(best > a && best < b)) return;
  s.peak_slip_velocity += best * (slope + curve * best);
  s.peak_position += best;
}

/// The foot of the fan of a step is a point of a curve. Of a smooth stress, it is where W reaches a thousandth of its
/// maximum.
double Along::trailing_front() const {
  const Contour& c = trains_.contour();
  if (c.front == Contour::nothing) return none;
  if (trains_.problem().corner < HUGE_VAL) return c.x[c.front];
  if (trains_.time() == 0) return none;
  constexpr double felt = 1e-3;
  double most = 0;
  for (const edges::Means& m : means_) most = std::fmax(most, std::fabs(m.W));
  const std::size_t n = nodes_.size();
  for (std::size_t i = 1; i < n && most > 0; ++i) {
    const std::size_t here = c.stressed_left ? i : n - 1 - i, ahead = c.stressed_left ? here - 1 : here + 1;
    const double level = felt * most, before = std::fabs(means_[ahead].W), after = std::fabs(means_[here].W);
    if (after < level) continue;
    const double share = before > 0 ? std::log(level / before) / std::log(after / before) : 1;
    return std::lerp(nodes_[ahead], nodes_[here], share);
  }
  return none;
}

/// The free edge; the first dislocations of a step that overtake others; or where W falls to half of its maximum.
double Along::leading_front() const {
  const Contour& c = trains_.contour();
  const bool to_right = c.stressed_left;
  if (to_right ? c.right_free : c.left_free) {
    double edge = to_right ? -HUGE_VAL : HUGE_VAL;
    for (std::size_t i = 0; i < c.size(); ++i)
      if (!c.is_end(i)) edge = to_right ? std::fmax(edge, c.x[i]) : std::fmin(edge, c.x[i]);
    return edge;
  }
  if (trains_.problem().corner < HUGE_VAL && c.tip != Contour::nothing) return c.x[c.tip];
  double half = 0;
  for (const edges::Means& m : means_) half = std::fmax(half, std::fabs(m.W) / 2);
  const std::size_t n = nodes_.size();
  for (std::size_t i = 1; i < n && half > 0; ++i) {
    const std::size_t in = to_right ? n - 1 - i : i, out = to_right ? in + 1 : in - 1;
    const double a = std::fabs(means_[in].W), b = std::fabs(means_[out].W);
    if (a >= half && b < half) return std::lerp(nodes_[in], nodes_[out], (half - a) / (b - a));
  }
  return none;
}

output::Fronts Along::fronts(double threshold, double peak) const {
  const Contour& c = trains_.contour();
  std::vector<double> x, speed;
  for (std::size_t i = 0; i < nodes_.size(); ++i) {
    if (!in_domain(i)) continue;
    x.push_back(nodes_[i]);
    speed.push_back(std::fabs(means_[i].W));
  }
  const output::Observed seen = output::observed_fronts(x, speed, threshold * std::fabs(peak), x.front(), x.back());
  return {.trailing = visible(trailing_front()),
          .leading = visible(leading_front()),
          .trailing_characteristic = c.front == Contour::nothing ? none : visible(c.x[c.front]),
          .trailing_observed = c.stressed_left ? seen.left : seen.right,
          .leading_observed = c.stressed_left ? seen.right : seen.left};
}

output::Snapshot Along::snapshot(const output::Schedule& schedule) const {
  output::Snapshot s{};
  s.time = trains_.time();
  s.profile = profile(schedule.x_edges);
  const edges::Means& origin = means_[at(0)];
  s.slip_velocity_at_origin = origin.W;
  s.stress_at_origin = origin.k;
  s.slip_at_origin = slip_at_origin();
  find_peak(s);
  s.fronts = fronts(schedule.threshold, s.peak_slip_velocity);
  s.energy = energy_;
  return s;
}

}  // namespace slipfront::pulse
