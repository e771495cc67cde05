#include "chain/events/front_log.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "chain/events/event_log.hpp"
#include "foundation/math/constants.hpp"

namespace slipfront::chain {

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

}  // namespace slipfront::chain
