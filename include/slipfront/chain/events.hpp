#pragma once
/// \file
/// Slip events of a loaded chain, found while it moves (docs/loading.md).

#include <cstddef>
#include <vector>

#include "slipfront/output/slip_event.hpp"

namespace slipfront::chain {

using Event = output::SlipEvent;  ///< in the units of the chain that reports it

/// The places: equal parts of a chain, whose mean slip velocity is looked at. `x` are their middles.
struct Places {
  std::vector<double> x, u, velocity;  ///< u at the end of a step, the velocity that friction felt in it
  double length = 0;                   ///< of one
};

/// Watches the places of a chain step by step.
class EventLog {
 public:
  EventLog() = default;
  explicit EventLog(double threshold) : threshold_(threshold) {}

  bool active() const { return threshold_ > 0; }
  double threshold() const { return threshold_; }
  /// After a step that ended at `time`; `load` is the mean force that loads a place then.
  void look(double time, double load, const Places& places);
  const std::vector<Event>& events() const { return events_; }

  /// All that it needs to go on, to the same bits.
  std::vector<double> saved() const;
  /// \throws InputError unless `saved` is of a log of this kind.
  void resume(const std::vector<double>& saved);

 private:
  void begin(double time, double load, const Places& places, double largest, std::size_t first);
  void follow(double time, double load, const Places& places, double largest);
  double front_velocity() const;

  double threshold_ = 0;
  bool within_ = false;
  double last_time_ = 0, last_load_ = 0, last_largest_ = 0, first_load_ = 0;
  std::vector<double> x_, last_u_, last_velocity_, first_u_;
  std::vector<double> arrivals_;  ///< when each place passed the threshold, in this event; NaN: not yet
  std::vector<Event> events_;
};

}  // namespace slipfront::chain
