#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "slipfront/output/slip_event.hpp"

namespace slipfront::chain {

/// Equal parts of a chain, and their means after a step.
struct ChainParts {
  std::vector<double> x;            ///< of their middles
  std::vector<double> u, velocity;  ///< u at the end of the step; the velocity that friction felt in it
  double length = 0;                ///< of each
};

/// Finds the slip events of a loaded chain while it moves (docs/loading.md). All in the units of the chain.
class EventLog {
 public:
  EventLog() = default;
  explicit EventLog(double threshold) : threshold_(threshold) {}

  bool active() const { return threshold_ > 0; }
  /// After a step that ended at `time`; `load` is the mean force of the springs then.
  void look(double time, double load, const ChainParts& parts);
  const std::vector<output::SlipEvent>& events() const { return events_; }

  /// All that it needs to continue, to the same bits.
  std::vector<double> saved() const;
  /// \throws InputError unless `saved` is of such a log.
  void resume(const std::vector<double>& saved);

 private:
  void begin(double time, double load, const ChainParts& parts, double largest, std::size_t first);
  void follow(double time, double load, const ChainParts& parts, double largest);
  double front_velocity() const;

  /// The numbers and rows that a checkpoint holds, in its order.
  template <class Log>
  static auto numbers(Log& log) {
    return std::array{&log.last_time_, &log.last_load_, &log.last_largest_, &log.first_load_};
  }
  template <class Log>
  static auto rows(Log& log) {
    return std::array{&log.x_, &log.last_u_, &log.last_velocity_, &log.first_u_, &log.arrivals_};
  }

  double threshold_ = 0;
  bool within_ = false;
  double last_time_ = 0, last_load_ = 0, last_largest_ = 0, first_load_ = 0;
  std::vector<double> x_, last_u_, last_velocity_, first_u_;
  std::vector<double> arrivals_;  ///< when each part passed the threshold, in this event; NaN: not yet
  std::vector<output::SlipEvent> events_;
};

}  // namespace slipfront::chain
