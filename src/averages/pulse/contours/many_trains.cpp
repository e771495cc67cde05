#include "averages/pulse/contours/many_trains.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "averages/pulse/contours/contour.hpp"
#include "averages/pulse/contours/sweep.hpp"
#include "math/digits.hpp"
#include "slipfront/error.hpp"

namespace slipfront::pulse {
namespace {

/// W at x = 0 now.
double velocity_at_origin(const Contour& contour) {
  double W = 0;
  constexpr std::array<double, 1> origin{0};
  Sweep(contour).at(origin, [&](std::size_t, const std::vector<double>& edges) { W = edges::means_of(edges).W; });
  return W;
}

}  // namespace

ManyTrains::ManyTrains(Problem given)
    : problem_(std::move(given)),
      start_(contour_at_rest(problem_)),
      now_(start_),
      state_{.curves = start_},
      viscosity_(problem_.friction.linear_coefficient().value_or(0)) {}

/// A train continues outside the domain with the load of the end.
edges::Forces ManyTrains::forces(double x, double time) const {
  if (!driven()) return {};
  return {.load = problem_.forcing ? problem_.forcing(std::clamp(x, problem_.left, problem_.right), time) : 0,
          .viscosity = viscosity_};
}

void ManyTrains::find_velocities(double time, const Points& points, Points& velocities) {
  now_.x = points.x;
  now_.r = points.r;
  velocities.x.assign(points.x.size(), 0.0);
  velocities.r.assign(points.x.size(), 0.0);
  third_train_ = {};
  double before_x = 0;
  bool before_was_third = false;
  sweep_.at_points([&](std::size_t point, const std::vector<double>& edges, std::size_t own) {
    velocities.x[point] = edges::speed_of(edges, own);
    if (!driven()) return;
    const edges::Source source = edges::source_of(edges, own, forces(now_.x[point], time));
    velocities.r[point] = source.change;
    constexpr double wide = 0.02;
    const bool third = source.left_out > wide;
    if (third && before_was_third) third_train_ = {third_train_.extent + (now_.x[point] - before_x), now_.x[point]};
    before_x = now_.x[point];
    before_was_third = third;
  });
  if (problem_.forcing) find_changes_of_ends(time, velocities);
}

void ManyTrains::find_changes_of_ends(double time, Points& velocities) const {
  for (const double side : {-1.0, 1.0}) {
    const std::vector<std::size_t> both = now_.ends(side);
    if (both.empty()) continue;
    const std::vector<double> edges{now_.r[both[0]], now_.r[both[1]]};
    for (std::size_t j = 0; j < 2; ++j)
      velocities.r[both[j]] = edges::source_of(edges, j, forces(side * Contour::far_away, time)).change;
  }
}

/// The fast front runs out of the domain on one edge, while the first point of the other edge runs in. Friction changes
/// both edges behind the front, so that the other edge gets a new first point at the front. Returns whether it did.
bool ManyTrains::extend(double side) {
  Contour& c = state_.curves;
  const std::vector<std::size_t> both = c.ends(side);
  if (both.empty()) return false;
  const auto first = [&c](std::size_t end) { return c.next[end] == Contour::nothing ? c.previous[end] : c.next[end]; };
  const std::size_t a = first(both[0]), b = first(both[1]);
  const bool a_is_inside = (c.x[b] - c.x[a]) * side > 0;
  const std::size_t end = both[a_is_inside ? 0 : 1], inside = a_is_inside ? a : b, outside = a_is_inside ? b : a;
  if (std::fabs(c.x[a] - c.x[b]) < (problem_.right - problem_.left) / problem_.cells) return false;
  const std::size_t made = c.insert_behind(c.next[end] == inside ? end : inside, c.x[outside], c.r[end]);
  c.corner[made] = true;  // its curve has no tangent towards the end, which is far away
  c.corner[inside] = false;
  return true;
}

/// Integrals over the domain by the two-point Gauss rule between the points of the curves.
Work ManyTrains::power() const {
  const double left = problem_.left, right = problem_.right;
  std::vector<double> nodes{left, right};
  for (const double x : now_.x)
    if (x > left && x < right) nodes.push_back(x);
  std::sort(nodes.begin(), nodes.end());
  nodes.erase(std::unique(nodes.begin(), nodes.end()), nodes.end());
  std::vector<double> x{-Contour::far_away / 2, left};
  for (std::size_t i = 0; i + 1 < nodes.size(); ++i) {
    for (const double point : gauss_points(nodes[i], nodes[i + 1])) x.push_back(point);
  }
  x.push_back(right);
  x.push_back(Contour::far_away / 2);
  Work rate;
  Sweep(now_).at(x, [&](std::size_t i, const std::vector<double>& edges) {
    const edges::Means here = edges::means_of(edges);
    if (i == 0) {
      rate.slip_at_left = here.W;
    } else if (i == 1) {
      rate.through_ends += here.P;
    } else if (i + 2 == x.size()) {
      rate.through_ends -= here.P;
    } else if (i + 1 == x.size()) {
      rate.slip_at_right = here.W;
    } else {
      const double half = (nodes[i / 2] - nodes[i / 2 - 1]) / 2;
      const edges::Forces f = forces(x[i], state_.time);
      rate.dissipated += half * f.viscosity * here.squared_rate;
      rate.supplied += half * f.load * here.W;
    }
  });
  return rate;
}

/// Integrates the power over the last step by the trapezoidal rule.
void ManyTrains::add_work(double length) {
  const Work before = *power_, now = power();
  for (double Work::*part :
       {&Work::dissipated, &Work::supplied, &Work::through_ends, &Work::slip_at_left, &Work::slip_at_right})
    state_.work.*part += length / 2 * (before.*part + now.*part);
  power_ = now;
}

/// A small part of the time in which the fastest point crosses the domain, or the time in which friction acts. The
/// points of a fan begin at one x, where friction changes their rapidities as it does nowhere else.
double ManyTrains::first_step() const {
  double fastest = 0;
  for (const double v : velocities_.x) fastest = std::fmax(fastest, std::fabs(v));
  const double crossing = (driven() ? 1e-7 : 1e-3) * (problem_.right - problem_.left) / fastest;
  return viscosity_ > 0 ? std::fmin(crossing, 1 / viscosity_) : crossing;
}

double ManyTrains::expected_steps(double duration) const { return std::fmax(200, viscosity_ * duration); }

std::string ManyTrains::reason_of_short_steps() const {
  const std::vector<double>& v = velocities_.x;
  std::size_t fastest = 0;
  for (std::size_t i = 0; i < v.size(); ++i)
    if (std::fabs(v[i]) > std::fabs(v[fastest])) fastest = i;
  return "the edges of the trains change their speeds fast near x = " + digits(state_.curves.x[fastest]);
}

/// A step of Bogacki and Shampine (1989, Appl. Math. Lett. 2:321), third order with an error estimate of second order.
/// The tolerance is relative to the distance of the fastest point so far, and to the range of rapidities. We take the
/// mean square over all points, because the speed at the end of a fold changes with the logarithm of the distance from
/// it.
StepAttempt ManyTrains::attempt(const Points& before, double length) {
  constexpr double tighter = 0.5;  // than that of one train, which limits the error of each step by its cells
  const auto combine = [n = before.x.size()](Points& to, const auto& value) {
    to.x.resize(n);
    to.r.resize(n);
    for (std::size_t i = 0; i < n; ++i) {
      to.x[i] = value(i, &Points::x);
      to.r[i] = value(i, &Points::r);
    }
  };
  using Part = std::vector<double> Points::*;
  const double t = state_.time;
  combine(stage_, [&](std::size_t i, Part p) { return (before.*p)[i] + length / 2 * (velocities_.*p)[i]; });
  find_velocities(t + length / 2, stage_, second_);
  combine(stage_, [&](std::size_t i, Part p) { return (before.*p)[i] + 3 * length / 4 * (second_.*p)[i]; });
  find_velocities(t + 3 * length / 4, stage_, third_);
  combine(stage_, [&](std::size_t i, Part p) {
    return (before.*p)[i] + length * (2 * (velocities_.*p)[i] + 3 * (second_.*p)[i] + 4 * (third_.*p)[i]) / 9;
  });
  find_velocities(t + length, stage_, last_);
  state_.curves.x = stage_.x;
  state_.curves.r = stage_.r;
  const auto [lowest, highest] = std::minmax_element(before.r.begin(), before.r.end());
  double fastest = 0, squares = 0, squares_r = 0;
  for (std::size_t i = 0; i < before.x.size(); ++i) {
    const auto off = [&](Part p) {
      return length * (-5 * (velocities_.*p)[i] + 6 * (second_.*p)[i] + 8 * (third_.*p)[i] - 9 * (last_.*p)[i]) / 72;
    };
    squares += off(&Points::x) * off(&Points::x);
    squares_r += off(&Points::r) * off(&Points::r);
    fastest = std::fmax(fastest, std::fabs(velocities_.x[i]));
  }
  const auto points = static_cast<double>(before.x.size());
  const double tolerance = tighter * problem_.explicit_tolerance, allowed = tolerance * fastest * (t + length);
  const double error = fastest > 0 ? std::hypot(std::sqrt(squares / points) / allowed,
                                                std::sqrt(squares_r / points) / (tolerance * (*highest - *lowest)))
                                   : 0;
  return {.succeeded = std::isfinite(error), .error = std::fmax(error, 1e-6)};
}

void ManyTrains::step(double target) {
  if (velocities_.x.empty()) find_velocities(state_.time, points(), velocities_);
  if (driven() && !power_) power_ = power();
  const Points before = points();
  const double wanted = std::fmin(state_.step > 0 ? state_.step : first_step(), problem_.longest_step);
  const double remaining = target - state_.time, length = step_within(remaining, wanted);
  const StepTaken taken = take_step(
      StepControl{.order = 3}, length, [&](double dt) { return attempt(before, dt); },
      [&](double dt, int attempts) {
        constexpr int most_attempts = 40;
        if (attempts < most_attempts) return false;
        throw NumericsError("t = " + digits(state_.time) + ": no step of " + digits(dt) +
                            " or more is accurate enough; " + reason_of_short_steps());
      });
  aimed_ = length != wanted;
  state_.time = taken.length == remaining ? target : state_.time + taken.length;
  state_.step = taken.next;
  state_.steps += 1;
  std::swap(velocities_, last_);
  const bool smoothed = remove_sawteeth(), refined = driven() && refine();
  if (smoothed || refined) find_velocities(state_.time, points(), velocities_);
  constexpr double seen = 0.01;  // at the start of a fold, points overtake each other within their spacing
  if (third_train_.extent > seen * (problem_.right - problem_.left)) state_.third_train = third_train_.x;
  if (driven()) add_work(taken.length);
  state_.slip.add(state_.time, velocity_at_origin(now_), 0);
}

/// If a curve is nearly vertical, as it is if a gap opens, neighbouring points may overtake each other and back, by
/// less than their spacing resolves. Points between two such turns are replaced by means with their neighbours.
bool ManyTrains::remove_sawteeth() {
  constexpr int fewest = 4;  // points of a fold
  const Contour& c = now_;
  const auto turns = [&c](std::size_t i) {
    return !c.is_end(i) && !c.corner[i] && (c.x[c.previous[i]] < c.x[i]) != (c.x[i] < c.x[c.next[i]]);
  };
  bool found = false;
  for (std::size_t first = 0; first < c.size(); ++first) {
    if (!turns(first)) continue;
    std::size_t last = first;
    for (std::size_t i = c.next[first], j = 0; j < fewest && !c.is_end(i) && !c.corner[i]; i = c.next[i], ++j)
      if (turns(i)) last = i;
    if (last == first) continue;
    found = true;
    for (std::size_t i = first;; i = c.next[i]) {
      state_.curves.x[i] = (c.x[c.previous[i]] + 2 * c.x[i] + c.x[c.next[i]]) / 4;
      if (i == last) break;
    }
  }
  return found;
}

/// The stretch of x on which friction and load change the rapidities of points.
ManyTrains::Interval ManyTrains::driven_stretch() const {
  constexpr double felt = 0.01;
  const std::vector<double>&rate = velocities_.r, &x = state_.curves.x;
  double fastest = 0;
  for (std::size_t i = 0; i < rate.size(); ++i)
    if (!now_.is_end(i)) fastest = std::fmax(fastest, std::fabs(rate[i]));
  Interval stretch{problem_.right, problem_.left};
  for (std::size_t i = 0; i < rate.size(); ++i) {
    if (now_.is_end(i) || std::fabs(rate[i]) < felt * fastest) continue;
    stretch.left = std::fmin(stretch.left, x[i]);
    stretch.right = std::fmax(stretch.right, x[i]);
  }
  return stretch.right > stretch.left ? stretch : Interval{problem_.left, problem_.right};
}

/// Friction draws curves out, and lets points run together elsewhere. We add points on the curves between those that
/// are far apart, and remove those that are close to both neighbours.
bool ManyTrains::refine() {
  constexpr double far = 3, close = 0.1;  // in units of the range of rapidities over problem_.cells
  constexpr std::size_t most = 4;         // times the points at the start
  Contour& c = state_.curves;
  const auto [lowest, highest] = std::minmax_element(c.r.begin(), c.r.end());
  const Interval stretch = driven_stretch();
  const double range = *highest - *lowest, width = stretch.right - stretch.left, unit = 1.0 / problem_.cells;
  const auto apart = [&](std::size_t a, std::size_t b) {
    return std::hypot(Contour::weight_of_x * (c.x[b] - c.x[a]) / width, (c.r[b] - c.r[a]) / range);
  };
  bool changed = false;
  for (std::size_t i = 0; i < c.size(); ++i) {
    const bool kept = c.is_end(i) || c.corner[i] || i == c.front || i == c.tip;
    if (kept || c.is_end(c.previous[i]) || c.is_end(c.next[i])) continue;
    if (apart(c.previous[i], i) + apart(i, c.next[i]) > close * unit) continue;
    c.remove(i--);
    changed = true;
  }
  const std::size_t size = c.size();
  for (std::size_t i = 0; i < size && c.size() < most * start_.size(); ++i) {
    if (c.is_end(i) || c.is_end(c.next[i]) || apart(i, c.next[i]) < far * unit) continue;
    c.add_behind(i);
    changed = true;
  }
  for (const double side : {-1.0, 1.0}) changed = extend(side) || changed;
  if (changed) now_ = c;
  return changed;
}

double ManyTrains::last_time(const Problem& problem) {
  constexpr double worn_off = 4;  // C t
  const double viscosity = problem.friction.linear_coefficient().value_or(0);
  return viscosity > 0 ? worn_off / viscosity : HUGE_VAL;
}

bool ManyTrains::can_follow(const Problem& problem) {
  constexpr double resolved = 10;  // cells
  return last_time(problem) > resolved * (problem.right - problem.left) / problem.cells;
}

std::string ManyTrains::third_train() const {
  if (std::isnan(state_.third_train)) return {};
  return "pulse: three trains are at x = " + digits(state_.third_train) + " from t = " + digits(time()) +
         " on; the effect of friction and load is known for up to two trains, so that from then on one train with " +
         "shocks stands for them";
}

bool ManyTrains::advance_to(double target, const std::function<bool()>& after_step) {
  const double last = last_time(problem_);
  while (time() < target && !is_over()) {
    step(std::fmin(target, last));
    aimed_ = aimed_ && target <= last;
    if (after_step()) break;
  }
  return time() >= target;
}

void ManyTrains::archive(Archive& a) {
  a(state_);
  if (!a.reads()) return;
  now_ = state_.curves;
  velocities_ = {};
  power_.reset();
}

std::optional<SlipTwice> ManyTrains::slip_twice() const { return slip_twice(Along(*this)); }

std::optional<SlipTwice> ManyTrains::slip_twice(const Along& along) const {
  if (!state_.slip.can_compare(problem_)) return std::nullopt;
  return state_.slip.compare(time(), along.slip_at_origin(), velocity_at_origin(now_));
}

double ManyTrains::conservation_error() const { return Along(*this).conservation_error(); }

output::Snapshot ManyTrains::observe(const output::Schedule& schedule) const {
  return Along(*this, schedule.x_edges).snapshot(schedule);
}

output::Findings ManyTrains::findings(const std::vector<output::Snapshot>& snapshots) const {
  output::Findings found;
  if (snapshots.empty()) return found;
  double largest = 0, motion = 0;
  for (const output::Snapshot& s : snapshots) motion = std::fmax(motion, s.energy.kinetic);
  for (const double slip : snapshots.back().profile.slip) largest = std::fmax(largest, std::fabs(slip));
  const Along along(*this);
  if (const std::optional<SlipTwice> slip = slip_twice(along)) {
    constexpr double rounding = 1e-12;
    const double difference = std::fabs(slip->by_place - slip->by_velocity);
    const double excess = difference - 3 * slip->sampling - rounding * along.count();
    found.violation(excess / std::fmax(largest, state_.slip.size()),
                    "pulse: slip at x = 0 is " + digits(slip->by_place) + ", the integral of the slip velocity there " +
                        digits(slip->by_velocity) + "; more cells help");
  }
  const double uncounted = along.conservation_error();
  found.violation(uncounted, "pulse: the trains hold " + digits(100 * uncounted) +
                                 " % more or fewer dislocations than there are; more cells help");
  constexpr double worth = 0.01;  // results count as wrong if as much energy is created or lost as moves
  const output::Energy& now = snapshots.back().energy;
  const double interpolated = now.elastic / std::pow(problem_.cells, 3);  // error of interpolation between the points
  const double energy = std::fmax(std::fabs(now.residual) - interpolated, 0) / motion;
  if (motion > 0)
    found.violation(worth * energy, "pulse: energy is not conserved, by " + digits(100 * energy) +
                                        " % of the energy of motion; more cells help");
  return found;
}

}  // namespace slipfront::pulse
