#include "lattice/chain/events/event_log.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <string>
#include <utility>

#include "math/constants.hpp"
#include "math/digits.hpp"
#include "slipfront/error.hpp"
#include "system/machine.hpp"

namespace slipfront::chain {
double crossing(double t0, double v0, double t1, double v1, double threshold) {
  if (!(v0 > 0) || !(v0 < threshold) || !(v1 > v0)) return t1;
  return t0 + (t1 - t0) * std::log(threshold / v0) / std::log(v1 / v0);
}

bool EventLog::moves(std::size_t part, double velocity) const {
  return velocity > threshold_ || (last_owner_[part] != 0 && velocity >= threshold_ / 2);
}

/// Calls each(stretch) for each stretch of parts that move. On a ring it may pass the last part.
template <class Each>
void EventLog::each_moving_stretch(const ChainParts& parts, const Each& each) const {
  const std::size_t n = parts.x.size();
  const auto moves_at = [&](std::size_t i) { return moves(i % n, parts.velocity[i % n]); };
  std::size_t start = 0;
  if (parts.ring)
    while (start < n && moves_at(start)) ++start;
  if (start == n) return each(Stretch{0, n});
  for (std::size_t i = start; i < start + n; ++i) {
    const std::size_t first = i;
    while (i < start + n && moves_at(i)) ++i;
    if (i > first) each(Stretch{first % n, i - first});
  }
}

void EventLog::look(double time, double load, const ChainParts& parts) {
  const std::size_t n = parts.x.size();
  const Step step{time, load, parts};
  x_ = parts.x;
  stiffness_ = parts.stiffness;
  part_length_ = parts.length;
  is_ring_ = parts.ring;
  owner_.resize(n, 0);
  joined_.clear();
  last_owner_ = owner_;
  std::fill(owner_.begin(), owner_.end(), std::size_t{0});
  each_moving_stretch(parts, [&](const Stretch& stretch) {
    std::size_t identity = earlier_event_of(stretch);
    if (identity == 0) identity = begin(step, stretch);
    for (std::size_t i = 0; i < stretch.count; ++i) owner_[(stretch.first + i) % n] = identity;
  });
  for (Open& open : open_) measure(step, open);
  end_finished();
  last_time_ = time;
  last_load_ = load;
  last_u_ = parts.u;
  last_velocity_ = parts.velocity;
}

/// The event in which the stretch, or a part next to it, moved in the last step; 0: none. If there are several, the
/// stretch connects them: they become the first of them.
std::size_t EventLog::earlier_event_of(const Stretch& stretch) {
  const std::size_t n = owner_.size();
  std::size_t found = 0;
  for (std::size_t i = 0; i < stretch.count + 2; ++i) {
    const bool outside = !is_ring_ && ((stretch.first == 0 && i == 0) || stretch.first + i > n);
    if (outside) continue;
    const std::size_t other = last_owner_[(stretch.first + i + n - 1) % n];
    if (other == 0 || other == found) continue;
    if (found != 0) join(std::max(found, other), std::min(found, other));
    found = found == 0 ? other : std::min(found, other);
  }
  return found;
}

std::size_t EventLog::begin(const Step& step, const Stretch& stretch) {
  const bool known = !last_u_.empty();
  const ChainParts& parts = step.parts;
  std::size_t fastest = stretch.first;
  for (std::size_t i = 0; i < stretch.count; ++i) {
    const std::size_t part = (stretch.first + i) % parts.x.size();
    if (parts.velocity[part] > parts.velocity[fastest]) fastest = part;
  }
  output::SlipEvent event;
  event.onset = arrival_of(step, fastest);
  event.load = known ? last_load_ : step.load;
  events_.push_back(event);
  identities_.push_back(++last_identity_);
  open_.push_back({.identity = last_identity_,
                   .origins = {{parts.x[fastest], event.onset}},
                   .fall_by_others = 0,
                   .first_u = known ? last_u_ : parts.u,
                   .arrivals = std::vector<double>(parts.x.size(), none)});
  return last_identity_;
}

/// Adds an event to an earlier one: the parts that moved in it, and what they slipped.
void EventLog::join(std::size_t from, std::size_t to) {
  const Open& later = open_of(from);
  Open& earlier = open_of(to);
  for (std::size_t i = 0; i < x_.size(); ++i) {
    if (std::isnan(later.arrivals[i])) continue;
    earlier.first_u[i] -= last_u_[i] - later.first_u[i];
    earlier.fall_by_others -= fall_of_load(i, last_u_[i] - later.first_u[i]);
    earlier.arrivals[i] = std::fmin(earlier.arrivals[i], later.arrivals[i]);  // a NaN counts as no time
  }
  output::SlipEvent& event = events_[index_of(to)];
  event.peak_velocity = std::fmax(event.peak_velocity, events_[index_of(from)].peak_velocity);
  event.merged += 1 + events_[index_of(from)].merged;
  earlier.origins.insert(earlier.origins.end(), later.origins.begin(), later.origins.end());
  for (auto* owners : {&owner_, &last_owner_}) std::replace(owners->begin(), owners->end(), from, to);
  joined_.push_back({from, to});
  remove(from);
  std::erase_if(open_, [&](const Open& open) { return open.identity == from; });
}

void EventLog::remove(std::size_t identity) {
  const auto index = static_cast<std::ptrdiff_t>(index_of(identity));
  events_.erase(events_.begin() + index);
  identities_.erase(identities_.begin() + index);
}

double EventLog::arrival_of(const Step& step, std::size_t part) const {
  if (last_velocity_.empty()) return step.time;
  return crossing(last_time_, last_velocity_[part], step.time, step.parts.velocity[part], threshold_);
}

/// The fall of the load, which is a mean over all parts, if one part slips.
double EventLog::fall_of_load(std::size_t part, double slip) const {
  return stiffness_.empty() ? 0 : stiffness_[part] * slip / static_cast<double>(x_.size());
}

/// Measures an event in progress. The slip of parts that move in another event belongs to that one, and so does the
/// fall of the load that it causes.
void EventLog::measure(const Step& step, Open& open) {
  const ChainParts& parts = step.parts;
  output::SlipEvent& event = events_[index_of(open.identity)];
  double sum = 0, moved = 0;
  event.largest_slip = 0;
  for (std::size_t i = 0; i < parts.x.size(); ++i) {
    const bool is_own = owner_[i] == open.identity;
    if (owner_[i] != 0 && !is_own && !last_u_.empty()) {
      open.first_u[i] += parts.u[i] - last_u_[i];
      open.fall_by_others += fall_of_load(i, parts.u[i] - last_u_[i]);
    }
    const double slip = parts.u[i] - open.first_u[i];
    sum += slip;
    event.largest_slip = std::fmax(event.largest_slip, slip);
    if (is_own) {
      event.peak_velocity = std::fmax(event.peak_velocity, parts.velocity[i]);
      if (std::isnan(open.arrivals[i])) open.arrivals[i] = arrival_of(step, i);
    }
    if (!std::isnan(open.arrivals[i])) moved += 1;
  }
  event.slip = sum / static_cast<double>(parts.x.size());
  event.stress_drop = event.load - step.load - open.fall_by_others;
  event.length = moved * parts.length;
  event.duration = step.time - event.onset;
  event.origin = moves_at_once(open) ? none : open.origins.front().x;
  event.rupture_velocity = front_velocity(open, event.duration);
}

/// An event ends when none of its parts moves.
void EventLog::end_finished() {
  for (const Open& open : open_) {
    if (std::find(owner_.begin(), owner_.end(), open.identity) != owner_.end()) continue;
    output::SlipEvent& event = events_[index_of(open.identity)];
    event.complete = 1;
    if (event.largest_slip < least_slip_) remove(open.identity);
  }
  std::erase_if(
      open_, [&](const Open& open) { return std::find(owner_.begin(), owner_.end(), open.identity) == owner_.end(); });
}

EventLog::Open& EventLog::open_of(std::size_t identity) {
  return *std::find_if(open_.begin(), open_.end(), [&](const Open& open) { return open.identity == identity; });
}

std::size_t EventLog::index_of(std::size_t identity) const {
  return static_cast<std::size_t>(std::lower_bound(identities_.begin(), identities_.end(), identity) -
                                  identities_.begin());
}

std::size_t EventLog::in_progress() const { return open_.empty() ? 0 : index_of(open_.back().identity) + 1; }

std::size_t EventLog::event_at(double x) const {
  if (open_.empty()) return 0;
  const auto n = static_cast<std::ptrdiff_t>(x_.size());
  const auto nearest = std::lround((x - x_.front()) / part_length_);
  for (const std::ptrdiff_t next : {0, -1, 1}) {
    std::ptrdiff_t part = std::clamp<std::ptrdiff_t>(nearest, 0, n - 1) + next;
    if (is_ring_) part = (part + n) % n;
    if (part < 0 || part >= n) continue;
    const auto i = static_cast<std::size_t>(part);
    if (owner_[i] != 0) return owner_[i];
    for (auto open = open_.rbegin(); open != open_.rend(); ++open)
      if (!std::isnan(open->arrivals[i])) return open->identity;
  }
  return 0;
}

/// Calls take(time, distance) for each part that moved: the time of its arrival since that of the nearest origin, and
/// the distance from there. On a ring the distance is the shorter way around.
template <class Take>
void EventLog::each_arrival(const Open& open, const Take& take) const {
  const double around = is_ring_ ? part_length_ * static_cast<double>(x_.size()) : HUGE_VAL;
  for (std::size_t i = 0; i < x_.size(); ++i) {
    if (std::isnan(open.arrivals[i])) continue;
    double nearest = HUGE_VAL, time = 0;
    for (const Origin& origin : open.origins) {
      const double straight = std::fabs(x_[i] - origin.x), d = std::fmin(straight, around - straight);
      if (d >= nearest) continue;
      nearest = d;
      time = open.arrivals[i] - origin.time;
    }
    take(time, nearest);
  }
}

/// Whether the parts that moved, two or more, did so within a thousandth of the time that waves take to the farthest of
/// them. Each part moved on its own then, and which of them is first depends on rounding.
bool EventLog::moves_at_once(const Open& open) const {
  constexpr double share_of_wave_time = 1e-3;
  double first = HUGE_VAL, last = -HUGE_VAL, farthest = 0;
  each_arrival(open, [&](double t, double d) {
    first = std::fmin(first, t);
    last = std::fmax(last, t);
    farthest = std::fmax(farthest, d);
  });
  return farthest > 0 && last - first < share_of_wave_time * farthest;
}

/// The slope of distance from the nearest origin against time, by least squares over the parts that moved. A slope
/// above c is no front: nothing travels that fast, so these parts moved on their own.
double EventLog::front_velocity(const Open& open, double duration) const {
  constexpr double at_once = 1e-3;  // fraction of the duration
  double count = 0, mean_t = 0, mean_d = 0, tt = 0, td = 0, first = HUGE_VAL, last = -HUGE_VAL;
  each_arrival(open, [&](double t, double d) {
    count += 1;
    first = std::fmin(first, t);
    last = std::fmax(last, t);
    mean_t += t;
    mean_d += d;
  });
  if (count < 3 || last - first < at_once * duration) return none;
  mean_t /= count;
  mean_d /= count;
  each_arrival(open, [&](double t, double d) {
    tt += (t - mean_t) * (t - mean_t);
    td += (t - mean_t) * (d - mean_d);
  });
  return td > 0 && td <= tt ? td / tt : none;
}

void EventLog::archive(Archive& a) {
  a(threshold_, last_time_, last_load_, part_length_, last_identity_, is_ring_);
  a(x_, last_u_, last_velocity_, owner_, identities_, events_);
  a.each(open_, [&](Open& open) { a(open.identity, open.origins, open.fall_by_others, open.first_u, open.arrivals); });
  a.require(is_consistent());
}

bool EventLog::is_consistent() const {
  const std::size_t n = x_.size();
  const auto is_open = [this](std::size_t identity) {
    return std::any_of(open_.begin(), open_.end(), [&](const Open& open) { return open.identity == identity; });
  };
  return owner_.size() == n && last_u_.size() == n && last_velocity_.size() == n &&
         std::is_sorted(identities_.begin(), identities_.end()) && events_.size() == identities_.size() &&
         std::all_of(owner_.begin(), owner_.end(), [&](std::size_t owner) { return owner == 0 || is_open(owner); }) &&
         std::all_of(open_.begin(), open_.end(), [&](const Open& open) {
           return open.first_u.size() == n && open.arrivals.size() == n && !open.origins.empty() &&
                  std::binary_search(identities_.begin(), identities_.end(), open.identity);
         });
}

FrontLog::FrontLog(double threshold, std::vector<double> x) : threshold_(threshold), above_since_(x.size(), none) {
  records_.x = std::move(x);
}

void FrontLog::look(double time, const std::vector<double>& velocity, const EventLog& log,
                    const std::function<Tractions()>& ahead) {
  for (std::size_t i = 0; i < velocity.size(); ++i) {
    if (!(velocity[i] > threshold_))
      above_since_[i] = none;
    else if (std::isnan(above_since_[i]))
      above_since_[i] =
          last_velocity_.empty() ? time : crossing(last_time_, last_velocity_[i], time, velocity[i], threshold_);
  }
  last_time_ = time;
  last_velocity_ = velocity;
  match_events(log, ahead);
  for (std::size_t i = 0; i < velocity.size(); ++i) {
    if (std::isnan(above_since_[i])) continue;
    output::FrontRecord* const record = record_of(log.event_at(records_.x[i]));
    if (record && std::isnan(record->arrival[i])) record->arrival[i] = above_since_[i];
  }
}

output::FrontRecord* FrontLog::record_of(std::size_t identity) {
  const auto found = std::lower_bound(identities_.begin(), identities_.end(), identity);
  if (found == identities_.end() || *found != identity) return nullptr;
  return &records_.events[static_cast<std::size_t>(found - identities_.begin())];
}

/// Adds the events that have begun, and removes those that the log of events has joined to others or does not count.
void FrontLog::match_events(const EventLog& log, const std::function<Tractions()>& ahead) {
  const std::size_t last = identities_.empty() ? 0 : identities_.back();
  for (const std::size_t identity : log.identities()) {
    if (identity <= last) continue;
    Tractions now = ahead();
    identities_.push_back(identity);
    records_.events.push_back({std::vector<double>(positions(), none), std::move(now.stress), std::move(now.traction)});
  }
  for (const EventLog::Joined& joined : log.joined()) {
    const output::FrontRecord* const later = record_of(joined.from);
    if (!later) continue;
    std::vector<double>& earlier = record_of(joined.to)->arrival;
    for (std::size_t i = 0; i < earlier.size(); ++i) earlier[i] = std::fmin(earlier[i], later->arrival[i]);
  }
  for (std::size_t i = identities_.size(); i-- > 0;) {
    if (std::binary_search(log.identities().begin(), log.identities().end(), identities_[i])) continue;
    identities_.erase(identities_.begin() + static_cast<std::ptrdiff_t>(i));
    records_.events.erase(records_.events.begin() + static_cast<std::ptrdiff_t>(i));
  }
}

void FrontLog::archive(Archive& a) {
  const std::size_t n = positions();
  a(last_time_, last_velocity_, identities_);
  a.require(last_velocity_.empty() || last_velocity_.size() == n);
  a.fixed(above_since_);
  a.each(records_.events, [&](output::FrontRecord& record) {
    a(record.arrival, record.stress, record.traction);
    for (const auto* column : {&record.arrival, &record.stress, &record.traction}) a.require(column->size() == n);
  });
  a.require(records_.events.size() == identities_.size());
}

std::size_t EventOutputs::scheduled() const {
  return static_cast<std::size_t>(std::count(of_event_.begin(), of_event_.end(), 0));
}

bool EventOutputs::wants(std::size_t event) {
  if (per_event_ == 0) return false;
  const bool ended = event == 0 && event_ != 0;
  if (event != event_) {
    if (event != 0) require_memory();
    event_ = event;
    first_ = all_.size();
    stride_ = 1;
    steps_ = 0;
  }
  if (event == 0) return ended;
  return ++steps_ >= stride_;
}

void EventOutputs::add(output::Snapshot snapshot) {
  add_bytes(snapshot);
  all_.push_back(std::move(snapshot));
  of_event_.push_back(1);
  steps_ = 0;
  if (event_ != 0) thin();
}

void EventOutputs::add_scheduled(output::Snapshot snapshot) {
  constexpr double bytes_between_checks = 1 << 26;
  add_bytes(snapshot);
  all_.push_back(std::move(snapshot));
  of_event_.push_back(0);
  if (bytes_ < checked_bytes_ + bytes_between_checks) return;
  checked_bytes_ = bytes_;
  require_memory();
}

void EventOutputs::set_all(std::vector<output::Snapshot> snapshots) {
  all_ = std::move(snapshots);
  bytes_ = 0;
  for (const output::Snapshot& snapshot : all_) add_bytes(snapshot);
}

void EventOutputs::add_bytes(const output::Snapshot& snapshot) {
  bytes_ += static_cast<double>(sizeof(double) * (5 * snapshot.profile.k.size() + snapshot.displacement.size()) +
                                sizeof(output::Dislocation) * snapshot.dislocations.size());
}

/// Deletes every second output of the event in progress if it has 2 N of them. The last one is kept.
void EventOutputs::thin() {
  const auto outputs =
      static_cast<std::size_t>(std::count(of_event_.begin() + static_cast<std::ptrdiff_t>(first_), of_event_.end(), 1));
  if (outputs < 2 * per_event_) return;
  std::size_t kept = first_, seen = 0;
  for (std::size_t i = first_; i < all_.size(); ++i) {
    if (of_event_[i] != 0 && ++seen % 2 == 1) continue;
    if (kept != i) all_[kept] = std::move(all_[i]);
    of_event_[kept++] = of_event_[i];
  }
  all_.resize(kept);
  of_event_.resize(kept);
  stride_ *= 2;
  bytes_ = 0;
  for (const output::Snapshot& snapshot : all_) add_bytes(snapshot);
}

/// \throws NumericsError if the snapshots fill half of the memory. Their file needs about as much again.
void EventOutputs::require_memory() const {
  if (bytes_ > usable_memory() / 2)
    throw NumericsError(std::to_string(all_.size()) + " outputs need " + digits(bytes_ / 1e9, 3) +
                        " GB of memory; fewer are needed");
}

void EventOutputs::archive(Archive& a) {
  a(event_, first_, stride_, steps_, of_event_);
  a.require(all_.size() <= of_event_.size() && first_ <= of_event_.size() && stride_ > 0);
  of_event_.resize(all_.size());
}

}  // namespace slipfront::chain
