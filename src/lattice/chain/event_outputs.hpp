#pragma once

#include <cstddef>
#include <utility>
#include <vector>

#include "slipfront/text/output/snapshot.hpp"
#include "system/archive.hpp"

namespace slipfront::chain {

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
