#include "chain/events/front_log.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

#include "chain/events/event_log.hpp"
#include "foundation/math/constants.hpp"
#include "slipfront/error.hpp"

namespace slipfront::chain {
namespace {

auto columns(auto& record) { return std::array{&record.arrival, &record.stress, &record.traction}; }

}  // namespace

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

std::vector<double> FrontLog::saved() const {
  std::vector<double> all{last_time_, static_cast<double>(last_velocity_.size()),
                          static_cast<double>(records_.events.size())};
  const auto add = [&](const std::vector<double>& column) { all.insert(all.end(), column.begin(), column.end()); };
  add(last_velocity_);
  add(above_since_);
  for (const std::size_t identity : identities_) all.push_back(static_cast<double>(identity));
  for (const output::FrontRecord& record : records_.events)
    for (const auto* column : columns(record)) add(*column);
  return all;
}

void FrontLog::resume(const std::vector<double>& saved) {
  const auto refuse = [] {
    throw InputError({.key = "resume", .problem = "its fronts are cut short", .allowed = "a file of this version"});
  };
  const std::size_t n = positions();
  if (saved.size() < 3) refuse();
  const double seen = saved[1], events = saved[2];
  const bool counts = (seen == 0 || seen == static_cast<double>(n)) && events >= 0;
  if (!counts || static_cast<double>(saved.size()) !=
                     3 + seen + static_cast<double>(n) + events * (1 + 3 * static_cast<double>(n)))
    refuse();
  auto at = saved.begin() + 3;
  const auto take = [&](std::vector<double>& column, std::size_t size) {
    column.assign(at, at + static_cast<std::ptrdiff_t>(size));
    at += static_cast<std::ptrdiff_t>(size);
  };
  last_time_ = saved[0];
  take(last_velocity_, static_cast<std::size_t>(seen));
  take(above_since_, n);
  std::vector<double> identities;
  take(identities, static_cast<std::size_t>(events));
  identities_.clear();
  for (const double identity : identities) {
    if (!(identity > 0 && identity < 9e15)) refuse();
    identities_.push_back(static_cast<std::size_t>(identity));
  }
  records_.events.assign(static_cast<std::size_t>(events), {});
  for (output::FrontRecord& record : records_.events)
    for (auto* column : columns(record)) take(*column, n);
}

}  // namespace slipfront::chain
