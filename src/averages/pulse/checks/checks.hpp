#pragma once

#include <optional>
#include <vector>

#include "averages/pulse/observe/observe.hpp"
#include "averages/pulse/solver.hpp"
#include "slipfront/text/output/quantities.hpp"
#include "slipfront/text/output/snapshot.hpp"
#include "system/archive.hpp"

namespace slipfront::pulse {

/// Slip at x = 0, computed in two ways that should agree.
struct SlipTwice {
  double by_place;     ///< from the positions of the dislocations
  double by_velocity;  ///< from the integral of the slip velocity over time
  double sampling;     ///< possible error of the integral due to its sampling in time
  double of_velocity;  ///< possible error of the integral due to errors of the slip velocity
  /// The part of their difference that sampling does not explain. It is at least the part that errors of the slip
  /// velocity may explain.
  double error() const;
};

/// Samples the slip velocity at x = 0 during a run, and integrates it.
class SlipRecord {
 public:
  void sample(const Solver& solver);
  /// A sample of the slip velocity at one time. `doubt` is its possible error.
  void add(double time, double velocity, double doubt);
  /// Empty if x = 0 is outside the domain, or if there are too few samples.
  std::optional<SlipTwice> compare(const Solver& solver) const;
  bool can_compare(const Problem& problem) const;
  /// `slip` and `velocity` are those at x = 0 now.
  SlipTwice compare(double time, double slip, double velocity) const;
  /// Integral of |slip velocity| over time.
  double size() const { return size_; }

  void archive(Archive& a) { a(integral_, size_, doubt_); }

 private:
  output::SampledIntegral integral_;
  double size_ = 0;
  double doubt_ = 0;  ///< integral of the possible error of the slip velocity, estimated in the cell at x = 0
};

/// The invariants that every run should obey: slip at x = 0 against the integral of the slip velocity there, energy
/// that must not appear from nothing, the number of dislocations, and streams that must not cross.
class Checks {
 public:
  Checks(const Solver& solver, const StoredEnergy& at_start, const SlipRecord& slip,
         const std::vector<output::Snapshot>& snapshots)
      : solver_(solver), at_start_(at_start), slip_(slip), snapshots_(snapshots) {}

  output::Findings findings() const;

 private:
  void check_slip(output::Findings& found) const;
  void check_count(output::Findings& found) const;
  void check_energy(output::Findings& found) const;
  /// Largest slip at x = 0 and in the last profile.
  double largest_slip(const View& view) const;
  /// Slip of the cell at x = 0 where nothing has moved farther than a few cells, whose inside is not known well; else
  /// 0.
  double unresolved_slip(const View& view) const;
  /// Largest energy that was moving or dissipated, or that the forcing supplied, at an output time.
  double energy_of_motion() const;
  /// Share of the stored energy that the cells leave open where a contact profile acts: as large a share of the forces
  /// that should balance there does not.
  double contact_doubt() const;
  /// How far the change of the stored energy may be wrong because it is a sum over cells.
  double energy_doubt() const;

  const Solver& solver_;
  const StoredEnergy& at_start_;
  const SlipRecord& slip_;
  const std::vector<output::Snapshot>& snapshots_;
};

}  // namespace slipfront::pulse
