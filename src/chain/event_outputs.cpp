#include "chain/event_outputs.hpp"

#include <algorithm>
#include <cstddef>
#include <string>
#include <utility>

#include "foundation/machine.hpp"
#include "foundation/text/digits.hpp"
#include "slipfront/error.hpp"

namespace slipfront::chain {

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
  all_.push_back(std::move(snapshot));
  of_event_.push_back(1);
  steps_ = 0;
  if (event_ != 0) thin();
}

void EventOutputs::add_scheduled(output::Snapshot snapshot) {
  all_.push_back(std::move(snapshot));
  of_event_.push_back(0);
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
}

/// \throws NumericsError if the snapshots fill half of the memory. Their file needs about as much again.
void EventOutputs::require_memory() const {
  if (all_.empty()) return;
  const auto bytes = static_cast<double>(5 * sizeof(double) * all_.size() * all_.back().profile.k.size());
  if (bytes > usable_memory() / 2)
    throw NumericsError(std::to_string(all_.size()) + " outputs of slip events need " + digits(bytes / 1e9, 3) +
                        " GB of memory; fewer for each event are needed");
}

void EventOutputs::archive(Archive& a) {
  a(event_, first_, stride_, steps_, of_event_);
  a.require(all_.size() <= of_event_.size() && first_ <= of_event_.size() && stride_ > 0);
  of_event_.resize(all_.size());
}

}  // namespace slipfront::chain
