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

void FrontLog::look(double time, const std::vector<double>& velocity, std::size_t events, bool within,
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
  if (events < records_.events.size()) records_.events.resize(events);  // the last one was no event
  if (events > records_.events.size()) {
    Tractions now = ahead();
    records_.events.push_back({above_since_, std::move(now.stress), std::move(now.traction)});
  } else if (within) {
    std::vector<double>& arrival = records_.events.back().arrival;
    for (std::size_t i = 0; i < arrival.size(); ++i)
      if (std::isnan(arrival[i])) arrival[i] = above_since_[i];
  }
}

std::vector<double> FrontLog::saved() const {
  std::vector<double> all{last_time_, static_cast<double>(last_velocity_.size()),
                          static_cast<double>(records_.events.size())};
  const auto add = [&](const std::vector<double>& column) { all.insert(all.end(), column.begin(), column.end()); };
  add(last_velocity_);
  add(above_since_);
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
  if (!counts || static_cast<double>(saved.size()) != 3 + seen + static_cast<double>(n) * (1 + 3 * events)) refuse();
  auto at = saved.begin() + 3;
  const auto take = [&](std::vector<double>& column, std::size_t size) {
    column.assign(at, at + static_cast<std::ptrdiff_t>(size));
    at += static_cast<std::ptrdiff_t>(size);
  };
  last_time_ = saved[0];
  take(last_velocity_, static_cast<std::size_t>(seen));
  take(above_since_, n);
  records_.events.assign(static_cast<std::size_t>(events), {});
  for (output::FrontRecord& record : records_.events)
    for (auto* column : columns(record)) take(*column, n);
}

}  // namespace slipfront::chain
