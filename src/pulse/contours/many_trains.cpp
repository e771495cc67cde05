#include "pulse/contours/many_trains.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "foundation/text/digits.hpp"
#include "pulse/contours/along.hpp"
#include "pulse/contours/edges.hpp"
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
    : problem_(std::move(given)), start_(contour_at_rest(problem_)), now_(start_), state_{.x = start_.x} {}

void ManyTrains::find_speeds(const std::vector<double>& x, std::vector<double>& speeds) {
  now_.x = x;
  speeds.assign(x.size(), 0.0);
  sweep_.at_points([&](std::size_t point, const std::vector<double>& edges, std::size_t own) {
    speeds[point] = edges::speed_of(edges, own);
  });
}

/// A thousandth of the time in which the fastest point crosses the domain.
double ManyTrains::first_step() const {
  double fastest = 0;
  for (const double v : speeds_) fastest = std::fmax(fastest, std::fabs(v));
  return 1e-3 * (problem_.right - problem_.left) / fastest;
}

double ManyTrains::expected_steps(double) const { return 200; }

std::string ManyTrains::reason_of_short_steps() const {
  const std::vector<double>& x = state_.x;
  std::size_t fastest = 0;
  for (std::size_t i = 0; i < speeds_.size(); ++i)
    if (std::fabs(speeds_[i]) > std::fabs(speeds_[fastest])) fastest = i;
  return "the edges of the trains change their speeds fast near x = " + digits(x[fastest]);
}

/// A step of Bogacki and Shampine (1989, Appl. Math. Lett. 2:321), third order with an error estimate of second order.
/// The tolerance is relative to the distance of the fastest point so far. We take the mean square over all points,
/// because the speed at the end of a fold changes with the logarithm of the distance from it.
StepAttempt ManyTrains::attempt(const std::vector<double>& before, double length) {
  constexpr double tighter = 0.5;  // than that of one train, which limits the error of each step by its cells
  const std::size_t n = before.size();
  stage_.resize(n);
  for (std::size_t i = 0; i < n; ++i) stage_[i] = before[i] + length / 2 * speeds_[i];
  find_speeds(stage_, second_);
  for (std::size_t i = 0; i < n; ++i) stage_[i] = before[i] + 3 * length / 4 * second_[i];
  find_speeds(stage_, third_);
  for (std::size_t i = 0; i < n; ++i)
    state_.x[i] = before[i] + length * (2 * speeds_[i] + 3 * second_[i] + 4 * third_[i]) / 9;
  find_speeds(state_.x, last_);
  double squares = 0, fastest = 0;
  for (std::size_t i = 0; i < n; ++i) {
    const double off = length * (-5 * speeds_[i] + 6 * second_[i] + 8 * third_[i] - 9 * last_[i]) / 72;
    squares += off * off;
    fastest = std::fmax(fastest, std::fabs(speeds_[i]));
  }
  const double allowed = tighter * problem_.explicit_tolerance * fastest * (state_.time + length);
  const double error = fastest > 0 ? std::sqrt(squares / static_cast<double>(n)) / allowed : 0;
  return {.succeeded = std::isfinite(error), .error = std::fmax(error, 1e-6)};
}

void ManyTrains::step(double target) {
  if (speeds_.empty()) find_speeds(state_.x, speeds_);
  const std::vector<double> before = state_.x;
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
  std::swap(speeds_, last_);
  if (remove_sawteeth()) find_speeds(state_.x, speeds_);
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
      state_.x[i] = (c.x[c.previous[i]] + 2 * c.x[i] + c.x[c.next[i]]) / 4;
      if (i == last) break;
    }
  }
  return found;
}

bool ManyTrains::advance_to(double target, const std::function<bool()>& after_step) {
  while (time() < target) {
    step(target);
    if (after_step()) break;
  }
  return time() >= target;
}

void ManyTrains::archive(Archive& a) {
  a(state_);
  if (!a.reads()) return;
  now_.x = state_.x;
  speeds_.clear();
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
  const double energy = std::fabs(snapshots.back().energy.residual) / motion;
  if (motion > 0)
    found.violation(worth * energy, "pulse: energy is not conserved, by " + digits(100 * energy) +
                                        " % of the energy of motion; more cells help");
  return found;
}

}  // namespace slipfront::pulse
