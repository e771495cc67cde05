#pragma once
/// \file
/// The interface of the runs of all solvers.

#include <functional>
#include <string>
#include <vector>

namespace slipfront {
class Archive;
}

namespace slipfront::output {

/// A problem, its output times, and the results so far. A run that is saved and resumed gives bitwise identical
/// results.
class Run {
 public:
  virtual ~Run() = default;

  /// Advances to the end, or until `interrupted` returns true. Returns whether the end was reached. The run can be
  /// saved when it calls `interrupted`. \throws NumericsError if the solver fails or the results are wrong.
  virtual bool go(const std::function<bool()>& interrupted = {}) = 0;

  virtual double time() const = 0;
  virtual long steps() const = 0;
  /// About how many steps the whole run takes; 0 if that is not known.
  virtual double expected_steps() const { return 0; }
  virtual bool finished() const = 0;
  /// Whether the run can be saved, also after a NumericsError.
  virtual bool can_checkpoint() const { return true; }
  /// (all ranks) Sentences that describe wrong or doubtful results so far.
  virtual std::vector<std::string> warnings() const = 0;
  virtual void archive(Archive& a) = 0;
  /// The state of the run as bytes, for a checkpoint that the same kind of machine can read.
  std::string saved() const;
};

}  // namespace slipfront::output
