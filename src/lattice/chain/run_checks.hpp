#pragma once

#include <vector>

#include "lattice/chain/run_observer.hpp"
#include "slipfront/text/output/quantities.hpp"
#include "slipfront/text/output/snapshot.hpp"

namespace slipfront::chain {

/// Checks the conditions that every chain run should meet. If one is not met, the run warns or throws a NumericsError.
class RunChecks {
 public:
  /// Checks a run that has made these snapshots. Both arguments must outlive the checks.
  RunChecks(const RunObserver& observer, const std::vector<output::Snapshot>& snapshots);

  /// (all) Makes all checks. Reads every site.
  output::Findings findings() const;

 private:
  void check_energy(const Balance& balance, output::Findings& found) const;
  void check_slip(output::Findings& found) const;
  void check_one_sign(const Balance& balance, output::Findings& found) const;
  void check_fronts(output::Findings& found) const;
  void check_speed_of_fronts(output::Findings& found) const;
  void check_observed_fronts(output::Findings& found) const;
  void check_barrier(output::Findings& found) const;
  void check_dislocations(output::Findings& found) const;

  const RunObserver& observer_;
  const ScaledProblem& scaled_;
  const Chain& chain_;
  const std::vector<output::Snapshot>& snapshots_;
};

}  // namespace slipfront::chain
