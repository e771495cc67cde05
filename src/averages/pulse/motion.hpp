#pragma once
/// \file
/// The motion of a pulse as a run sees it: with one train at each position (one_train.hpp), or with many
/// (contours/many_trains.hpp).

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "averages/pulse/checks/checks.hpp"
#include "math/constants.hpp"
#include "slipfront/averages/pulse/problem.hpp"
#include "slipfront/text/output/quantities.hpp"
#include "slipfront/text/output/snapshot.hpp"
#include "system/archive.hpp"

namespace slipfront::pulse {

class Motion {
 public:
  virtual ~Motion() = default;

  virtual const Problem& problem() const = 0;
  virtual double time() const = 0;
  virtual long steps() const = 0;
  /// Advances to `target`. Calls `after_step` after each step, and stops early if it returns true. Returns whether
  /// `target` was reached. \throws NumericsError.
  virtual bool advance_to(double target, const std::function<bool()>& after_step) = 0;
  /// Whether the last step might have been different if the target had been later.
  virtual bool aimed_at_target() const = 0;
  virtual double expected_steps(double duration) const = 0;
  /// Reason for short steps, as a sentence without a full stop.
  virtual std::string reason_of_short_steps() const = 0;

  /// Writes or reads the state.
  virtual void archive(Archive& a) = 0;

  /// The results now, apart from what output::complete adds.
  virtual output::Snapshot observe(const output::Schedule& schedule) const = 0;
  virtual output::Findings findings(const std::vector<output::Snapshot>& snapshots) const = 0;
  virtual std::optional<SlipTwice> slip_twice() const = 0;
  /// Relative error of the number of dislocations.
  virtual double conservation_error() const = 0;
  /// Time and x at which dislocations first overtake each other; NaN if they do not, or if that is no approximation.
  virtual double crossing_time() const { return none; }
  virtual double crossing_position() const { return none; }
};

}  // namespace slipfront::pulse
