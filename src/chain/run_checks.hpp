#pragma once

#include <vector>

#include "chain/run_observer.hpp"
#include "slipfront/output/self_check.hpp"
#include "slipfront/output/snapshot.hpp"

namespace slipfront::chain {

/// Conditions that every chain run should meet. A run that misses one warns, or ends with a NumericsError.
class RunChecks {
 public:
  /// Of a run that has made these snapshots. Both outlive the checks.
  RunChecks(const RunObserver& observer, const std::vector<output::Snapshot>& snapshots);

  /// (all) Looks at every site.
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
