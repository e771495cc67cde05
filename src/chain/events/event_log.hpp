#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "slipfront/output/slip_event.hpp"

namespace slipfront::chain {

/// The time at which a velocity passed `threshold` between two times, if its logarithm is linear in time.
double crossing(double t0, double v0, double t1, double v1, double threshold);

/// Means over equal parts of a chain after a step.
struct ChainParts {
  std::vector<double> x;            ///< the middle of each part
  std::vector<double> u, velocity;  ///< u at the end of the step; velocity at which friction was evaluated
  double length = 0;                ///< length of each part
  bool ring = false;                ///< the last part is next to the first one
};

/// Finds the slip events of a loaded chain while it moves (docs/loading.md). All values are in the units of the chain.
class EventLog {
 public:
  EventLog() = default;
  /// An event begins where a part is faster than `threshold`. It counts if a part has slipped by `least_slip` at its
  /// end: the velocities of steps are noisy, and errors of the steps are no slip.
  explicit EventLog(double threshold, double least_slip = 0) : threshold_(threshold), least_slip_(least_slip) {}

  bool active() const { return threshold_ > 0; }
  /// Call this after each step. `time` is the end of the step, and `load` the mean force of the springs at that time.
  void look(double time, double load, const ChainParts& parts);
  const std::vector<output::SlipEvent>& events() const { return events_; }
  std::size_t in_progress() const { return within_ ? events_.size() : 0; }  ///< number of the event; 0: none

  /// Returns all that the log needs to continue exactly.
  std::vector<double> saved() const;
  /// Continues from a saved log. \throws InputError if `saved` is not one.
  void resume(const std::vector<double>& saved);

 private:
  void begin(double time, double load, const ChainParts& parts, double largest, std::size_t first);
  void follow(double time, double load, const ChainParts& parts, double largest);
  double front_velocity(const ChainParts& parts) const;

  /// The numbers and rows that a checkpoint stores, in the order of the file.
  template <class Log>
  static auto numbers(Log& log) {
    return std::array{&log.last_time_, &log.last_load_, &log.last_largest_};
  }
  template <class Log>
  static auto rows(Log& log) {
    return std::array{&log.x_, &log.last_u_, &log.last_velocity_, &log.first_u_, &log.arrivals_};
  }

  double threshold_ = 0, least_slip_ = 0;
  bool within_ = false;
  double last_time_ = 0, last_load_ = 0, last_largest_ = 0;
  std::vector<double> x_, last_u_, last_velocity_, first_u_;
  std::vector<double> arrivals_;  ///< time at which each part passed the threshold in this event; NaN: not yet
  std::vector<output::SlipEvent> events_;
};

}  // namespace slipfront::chain
