#pragma once

#include <cstddef>
#include <functional>
#include <vector>

#include "chain/events/event_log.hpp"
#include "slipfront/output/slip_event.hpp"

namespace slipfront::chain {

/// Stress -u_x, and the force of friction and substrate on a site, at the positions of a FrontLog.
struct Tractions {
  std::vector<double> stress, traction;
};

/// Records when each slip event arrives at evenly spaced positions of a loaded chain (docs/loading.md). All values are
/// in the units of the chain.
class FrontLog {
 public:
  FrontLog() = default;
  FrontLog(double threshold, std::vector<double> x);

  bool active() const { return !records_.x.empty(); }
  std::size_t positions() const { return records_.x.size(); }
  /// Call this after each step, after the log of events has seen it. `ahead` returns the present stresses. It is called
  /// when an event begins.
  void look(double time, const std::vector<double>& velocity, const EventLog& log,
            const std::function<Tractions()>& ahead);
  const output::FrontRecords& records() const { return records_; }

  void archive(Archive& a);

 private:
  /// The record of an event; null if there is none.
  output::FrontRecord* record_of(std::size_t identity);
  void match_events(const EventLog& log, const std::function<Tractions()>& ahead);

  double threshold_ = 0, last_time_ = 0;
  std::vector<double> last_velocity_;  ///< empty before the first step
  std::vector<double> above_since_;    ///< time at which the velocity last rose above the threshold; NaN: it is below
  output::FrontRecords records_;
  std::vector<std::size_t> identities_;  ///< identities of the events of `records_`, as in the log of events
};

}  // namespace slipfront::chain
