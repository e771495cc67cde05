#pragma once

#include <vector>

#include "pulse/checks/slip_record.hpp"
#include "pulse/observe/energy.hpp"
#include "slipfront/output/self_check.hpp"
#include "slipfront/output/snapshot.hpp"

namespace slipfront::pulse {

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
