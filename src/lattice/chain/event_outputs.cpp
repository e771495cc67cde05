#include "lattice/chain/event_outputs.hpp"

#include <algorithm>
#include <cstddef>
#include <string>
#include <utility>

#include "math/digits.hpp"
#include "slipfront/error.hpp"
#include "system/machine.hpp"

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
