#pragma once

#include <cstddef>
#include <functional>
#include <utility>
#include <vector>

#include "slipfront/text/output/slip_event.hpp"
#include "slipfront/text/output/snapshot.hpp"
#include "system/archive.hpp"

namespace slipfront::chain {

/// The time at which a velocity passed `threshold` between two times, if its logarithm is linear in time.
double crossing(double t0, double v0, double t1, double v1, double threshold);

/// Means over equal parts of a chain after a step.
struct ChainParts {
  std::vector<double> x;            ///< the middle of each part
  std::vector<double> u, velocity;  ///< u at the end of the step; velocity at which friction was evaluated
  double length = 0;                ///< length of each part
  std::vector<double> stiffness =
      {};             ///< fall of the force on each part with its slip; empty: not all sites are pulled
  bool ring = false;  ///< the last part is next to the first one
};

/// Finds the slip events of a loaded chain while it moves (docs/loading.md). All values are in the units of the chain.
/// An event is connected in x and t: it consists of parts that move next to each other, at the same time or in
/// successive steps. Events that meet become one.
class EventLog {
 public:
  EventLog() = default;
  /// A part moves from the step at which it is faster than `threshold` until it is slower than half of that. An event
  /// counts if a part has slipped by `least_slip` at its end: the velocities of steps are noisy, and errors of the
  /// steps are no slip.
  explicit EventLog(double threshold, double least_slip = 0) : threshold_(threshold), least_slip_(least_slip) {}

  bool active() const { return threshold_ > 0; }
  /// Call this after each step. `time` is the end of the step, and `load` the mean force of the springs at that time.
  void look(double time, double load, const ChainParts& parts);
  const std::vector<output::SlipEvent>& events() const { return events_; }
  /// Number of the last event in progress, from 1; 0: none.
  std::size_t in_progress() const;

  /// Identities of the events, for a log of other quantities. They do not change if events before them disappear.
  const std::vector<std::size_t>& identities() const { return identities_; }
  /// The events that the last step joined to earlier ones.
  struct Joined {
    std::size_t from, to;
  };
  const std::vector<Joined>& joined() const { return joined_; }
  /// Identity of the event in progress to which position x belongs: that of its part, or else of a part next to it.
  /// 0: none.
  std::size_t event_at(double x) const;

  void archive(Archive& a);

 private:
  struct Step {
    double time, load;
    const ChainParts& parts;
  };
  /// Parts next to each other.
  struct Stretch {
    std::size_t first, count;
  };
  /// The part that moves first.
  struct Origin {
    double x, time;
  };
  /// An event in progress.
  struct Open {
    std::size_t identity = 0;
    std::vector<Origin> origins;   ///< its own, and those of the events that it has met
    double fall_by_others = 0;     ///< fall of the load by slip in other events since its begin
    std::vector<double> first_u;   ///< u of each part at its begin, plus what the part has slipped in other events
    std::vector<double> arrivals;  ///< time at which each part passed the threshold in this event; NaN: not yet
  };
  bool moves(std::size_t part, double velocity) const;
  template <class Each>
  void each_moving_stretch(const ChainParts& parts, const Each& each) const;
  std::size_t earlier_event_of(const Stretch& stretch);
  std::size_t begin(const Step& step, const Stretch& stretch);
  void join(std::size_t from, std::size_t to);
  void remove(std::size_t identity);
  double fall_of_load(std::size_t part, double slip) const;
  void measure(const Step& step, Open& open);
  void end_finished();
  Open& open_of(std::size_t identity);
  std::size_t index_of(std::size_t identity) const;
  double arrival_of(const Step& step, std::size_t part) const;
  template <class Take>
  void each_arrival(const Open& open, const Take& take) const;
  bool moves_at_once(const Open& open) const;
  double front_velocity(const Open& open, double duration) const;

  /// Whether the parts and the events, as they were read, belong together.
  bool is_consistent() const;

  double threshold_ = 0, least_slip_ = 0;
  double last_time_ = 0, last_load_ = 0;
  double part_length_ = 0;
  bool is_ring_ = false;
  std::vector<double> x_, last_u_, last_velocity_;
  std::vector<double> stiffness_;                ///< the stiffness of each part in the last step
  std::vector<std::size_t> owner_, last_owner_;  ///< identity of the event in which each part moves; 0: none
  std::vector<Open> open_;
  std::vector<Joined> joined_;
  std::vector<output::SlipEvent> events_;
  std::vector<std::size_t> identities_;  ///< ascending
  std::size_t last_identity_ = 0;
};

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

/// The snapshots of a run: those of the output times, and between them those of slip events (output.per_event = N).
///
/// The number of steps of an event is not known before it ends. So at first each step is output. Each time the event
/// has 2 N outputs, every second of them is deleted, and from then on only every second step that was output before is
/// output. An event of many steps therefore has N to 2 N outputs, evenly spread over its steps, and one more at its
/// end.
class EventOutputs {
 public:
  explicit EventOutputs(std::size_t per_event) : per_event_(per_event) {}

  /// Call this after each step. `event` is the number of the event in progress, from 1, or 0. Returns whether a
  /// snapshot of this step is wanted. \throws NumericsError if the snapshots do not fit into memory.
  bool wants(std::size_t event);
  /// Adds the snapshot that `wants` asked for.
  void add(output::Snapshot snapshot);
  /// Adds the snapshot of an output time. \throws NumericsError if the snapshots do not fit into memory.
  void add_scheduled(output::Snapshot snapshot);

  const std::vector<output::Snapshot>& all() const { return all_; }
  std::size_t scheduled() const;  ///< number of snapshots of output times

  /// Sets the snapshots for an archive that reads; the last ones may be missing.
  void set_all(std::vector<output::Snapshot> snapshots);
  /// Writes or reads everything but the snapshots. \throws InputError if they do not fit what it reads.
  void archive(Archive& a);

 private:
  void thin();
  void require_memory() const;
  void add_bytes(const output::Snapshot& snapshot);

  std::size_t per_event_;
  std::size_t event_ = 0;   ///< the event in progress; 0: none
  std::size_t first_ = 0;   ///< index of the first snapshot after the begin of the event
  std::size_t stride_ = 1;  ///< steps from one output to the next
  std::size_t steps_ = 0;   ///< steps since the last output
  std::vector<output::Snapshot> all_;
  double bytes_ = 0, checked_bytes_ = 0;  ///< bytes of their arrays, now and at the last check
  std::vector<char> of_event_;            ///< for each snapshot, whether it is of an event
};

}  // namespace slipfront::chain
