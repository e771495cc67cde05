#pragma once
/// \file
/// A chain run on a scenario: x and t stretched by a scale, friction divided by it (docs/chain.md), and reported back
/// in the scenario's own units. Yields the same snapshots as a pulse run, and can be saved and continued to the same
/// bits.

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "slipfront/chain/chain.hpp"
#include "slipfront/output/self_check.hpp"
#include "slipfront/output/snapshot.hpp"

namespace slipfront::chain {

/// A problem in the scenario's units.
struct ScaledProblem {
  double scale = 1;                                   ///< x and t are stretched by it
  double left = -1, right = 1;                        ///< of the scenario
  std::function<double(double)> stress;               ///< initial stress at x; everything at rest
  std::function<double(double x, double t)> forcing;  ///< F; null: none
  bool steady_forcing = false;                        ///< F does not depend on t
  double end = 0;  ///< how long F is looked at, and contacts age, for the step; 0: F may be strong
  std::function<double(double)> contact;  ///< a(x) at t = 0; null: 1
  friction::Friction friction;            ///< of the scenario; the closure does not matter
  Boundary boundary;
  Model model = Model::sine_gordon;
  double spacing = default_spacing;  ///< of the grid or lattice, in the chain's own (stretched) x
  Loading loading = {};              ///< in the scenario's units: force over slip, or stress over slip at a pulled end
  bool substrate = true;             ///< false: none
  bool implicit = false;             ///< steps; docs/loading.md
  double tolerance = 5e-5;           ///< of implicit steps
  double step = 0;                   ///< of time, in the chain's own t; 0: chosen (chosen_step)
  double window = 0;  ///< of averages at x = 0, in the scenario's x; 0: spacings of the train left of it, one for the
                      ///< slip, eight for velocity and stress
};

/// The same problem in the chain's own units. `share_of_machine` of it runs on this one. \throws InputError as check
/// does.
Problem problem_of(const ScaledProblem& scaled, double share_of_machine = 1);

/// What should not have changed since t = 0, and the present dislocations.
struct Balance {
  /// |energy + dissipated + outflow - supplied - by contacts - that at t = 0|, over the largest of them. Works are
  /// integrated level by level, but that of viscous friction alone over 200 samples or more.
  double energy_drift;
  double charge_error;  ///< charge less that at t = 0
  long dislocations;    ///< of either sign
  double steepest;      ///< largest difference of u between neighbouring sites
};

class RunObserver;

class Run {
 public:
  Run(const ScaledProblem& scaled, output::Schedule schedule, const Execution& execution);
  /// Continues a saved run. \throws InputError if it is of another.
  Run(const ScaledProblem& scaled, output::Schedule schedule, const Execution& execution, std::string_view saved,
      std::vector<output::Snapshot> snapshots);
  ~Run();
  Run(const Run&) = delete;
  Run& operator=(const Run&) = delete;

  /// Continues to the end, or until `interrupted` returns true; it is called every tenth of a second or so. Returns
  /// whether the end was reached.
  bool go(const std::function<bool()>& interrupted = {});

  const Chain& chain() const { return *chain_; }
  const output::Schedule& schedule() const { return schedule_; }
  const std::vector<output::Snapshot>& snapshots() const { return snapshots_; }
  bool can_checkpoint() const { return chain_->valid(); }  ///< whether the run can be saved
  bool finished() const { return snapshots_.size() == schedule_.times.size(); }
  std::string saved() const;

  double time() const { return chain_->time() / scale_; }  ///< of the scenario
  double scale() const { return scale_; }
  /// Windows at x = 0, in the scenario's x: of the slip (a box), and of velocity and stress (smooth_average), which the
  /// profiles share unless two output cells are wider.
  double window() const;
  double smooth_window() const;
  /// Looks at every site.
  Balance balance() const;

  /// Slip events of a loaded chain so far, in the scenario's units. The stress drop is of the force F on a site, or of
  /// the stress at a pulled end.
  std::vector<output::SlipEvent> events() const;

  /// A sentence for each thing that is wrong or doubtful in the results so far: invariants that do not hold (energy,
  /// slip at x = 0 against the integral of the velocity there, dislocations that none of the ends explains, |W| <= k,
  /// fronts inside the domain and slower than c), a grid that holds slow dislocations, and too few dislocations. Above
  /// 1 % `go` ends with a NumericsError that states the reason.
  std::vector<std::string> warnings() const;

 private:
  bool advance_to(double time, const std::function<bool()>& interrupted);
  void refuse_wrong(const output::Findings& findings) const;

  double scale_;
  output::Schedule schedule_;
  std::unique_ptr<Chain> chain_;
  std::unique_ptr<RunObserver> observer_;
  std::vector<output::Snapshot> snapshots_;
  std::optional<output::Findings> final_findings_;  ///< of a run that is finished
};

}  // namespace slipfront::chain
