#include "chain/events/event_log.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "foundation/math/constants.hpp"
#include "slipfront/error.hpp"

namespace slipfront::chain {
double crossing(double t0, double v0, double t1, double v1, double threshold) {
  if (!(v0 > 0) || !(v0 < threshold) || !(v1 > v0)) return t1;
  return t0 + (t1 - t0) * std::log(threshold / v0) / std::log(v1 / v0);
}

void EventLog::look(double time, double load, const ChainParts& parts) {
  const auto fastest = std::max_element(parts.velocity.begin(), parts.velocity.end());
  const double largest = *fastest;
  if (!within_ && largest > threshold_)
    begin(time, load, parts, largest, static_cast<std::size_t>(fastest - parts.velocity.begin()));
  if (within_) follow(time, load, parts, largest);
  last_time_ = time;
  last_load_ = load;
  last_largest_ = largest;
  last_u_ = parts.u;
  last_velocity_ = parts.velocity;
}

void EventLog::begin(double time, double load, const ChainParts& parts, double largest, std::size_t first) {
  within_ = true;
  const bool known = !last_u_.empty();
  output::SlipEvent event;
  event.onset = known ? crossing(last_time_, last_largest_, time, largest, threshold_) : time;
  event.origin = parts.x[first];
  first_u_ = known ? last_u_ : parts.u;
  event.load = known ? last_load_ : load;
  x_ = parts.x;
  arrivals_.assign(parts.x.size(), none);
  events_.push_back(event);
}

void EventLog::follow(double time, double load, const ChainParts& parts, double largest) {
  output::SlipEvent& event = events_.back();
  double sum = 0, moved = 0;
  event.largest_slip = 0;
  for (std::size_t i = 0; i < parts.x.size(); ++i) {
    const double slip = parts.u[i] - first_u_[i];
    sum += slip;
    event.largest_slip = std::fmax(event.largest_slip, slip);
    if (std::isnan(arrivals_[i]) && parts.velocity[i] > threshold_)
      arrivals_[i] =
          last_velocity_.empty() ? time : crossing(last_time_, last_velocity_[i], time, parts.velocity[i], threshold_);
    if (!std::isnan(arrivals_[i])) moved += 1;
  }
  event.slip = sum / static_cast<double>(parts.x.size());
  event.stress_drop = event.load - load;
  event.peak_velocity = std::fmax(event.peak_velocity, largest);
  event.length = moved * parts.length;
  event.duration = time - event.onset;
  event.rupture_velocity = front_velocity(parts);
  if (largest >= threshold_ / 2) return;
  event.complete = 1;
  within_ = false;
  if (event.largest_slip < least_slip_) events_.pop_back();
}

/// The slope of distance from the origin against time, by least squares over the parts that moved. On a ring the
/// distance is the shorter way around. A slope above c is no front: nothing travels that fast, so these parts moved on
/// their own.
double EventLog::front_velocity(const ChainParts& parts) const {
  constexpr double at_once = 1e-3;  // fraction of the duration
  const double around = parts.ring ? parts.length * static_cast<double>(parts.x.size()) : HUGE_VAL;
  double count = 0, mean_t = 0, mean_d = 0, tt = 0, td = 0, first = HUGE_VAL, last = -HUGE_VAL;
  const auto each = [&](const auto& take) {
    for (std::size_t i = 0; i < x_.size(); ++i)
      if (const double d = std::fabs(x_[i] - events_.back().origin); !std::isnan(arrivals_[i]))
        take(arrivals_[i], std::fmin(d, around - d));
  };
  each([&](double t, double d) {
    count += 1;
    first = std::fmin(first, t);
    last = std::fmax(last, t);
    mean_t += t;
    mean_d += d;
  });
  if (count < 3 || last - first < at_once * events_.back().duration) return none;
  mean_t /= count;
  mean_d /= count;
  each([&](double t, double d) {
    tt += (t - mean_t) * (t - mean_t);
    td += (t - mean_t) * (d - mean_d);
  });
  return td > 0 && td <= tt ? td / tt : none;
}

std::vector<double> EventLog::saved() const {
  std::vector<double> all{threshold_, within_ ? 1.0 : 0.0};
  for (const double* number : numbers(*this)) all.push_back(*number);
  all.push_back(static_cast<double>(events_.size()));
  for (const output::SlipEvent& event : events_)
    for (const auto& column : output::slip_event_columns()) all.push_back(event.*column.value);
  for (const auto* row : rows(*this)) {
    all.push_back(static_cast<double>(row->size()));
    all.insert(all.end(), row->begin(), row->end());
  }
  return all;
}

void EventLog::resume(const std::vector<double>& saved) {
  std::size_t at = 0;
  const auto refuse = [] {
    throw InputError({.key = "resume", .problem = "its events are cut short", .allowed = "a file of this version"});
  };
  const auto next = [&] {
    if (at >= saved.size()) refuse();
    return saved[at++];
  };
  const auto count = [&] {
    const double values = next();
    if (!(values >= 0 && values <= static_cast<double>(saved.size()))) refuse();
    return static_cast<std::size_t>(values);
  };
  threshold_ = next();
  within_ = next() != 0;
  for (double* number : numbers(*this)) *number = next();
  events_.clear();
  for (std::size_t remaining = count(); remaining > 0; --remaining) {
    output::SlipEvent event;
    for (const auto& column : output::slip_event_columns()) event.*column.value = next();
    events_.push_back(event);
  }
  for (auto* row : rows(*this)) {
    row->clear();
    for (std::size_t remaining = count(); remaining > 0; --remaining) row->push_back(next());
  }
}

}  // namespace slipfront::chain
