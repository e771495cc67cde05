#pragma once
/// \file
/// A chain run on a scenario: x and t stretched by a scale, friction divided by it (docs/chain.md), and reported back
/// in the scenario's own units. Yields the same snapshots as a pulse run, and can be saved and continued to the same
/// bits.

#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "slipfront/chain/measure.hpp"
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

class Run {
 public:
  Run(const ScaledProblem& scaled, output::Schedule schedule, const Execution& execution);
  /// Continues a saved run. \throws InputError if it is of another.
  Run(const ScaledProblem& scaled, output::Schedule schedule, const Execution& execution, std::string_view saved,
      std::vector<output::Snapshot> snapshots);

  /// Goes on to the end or until `interrupted`, asked every tenth of a second or so, says so. Returns whether the end
  /// was reached.
  bool go(const std::function<bool()>& interrupted = {});

  const Chain& chain() const { return chain_; }
  const output::Schedule& schedule() const { return schedule_; }
  const std::vector<output::Snapshot>& snapshots() const { return snapshots_; }
  bool can_checkpoint() const { return can_checkpoint_; }  ///< false after a NumericsError: not to be saved
  bool finished() const { return snapshots_.size() == schedule_.times.size(); }
  std::string saved() const;

  double time() const { return chain_.time() / scaled_.scale; }  ///< of the scenario
  double scale() const { return scaled_.scale; }
  /// Windows at x = 0, in the scenario's x: of the slip (a box), and of velocity and stress (smooth_average), which the
  /// profiles share unless two output cells are wider.
  double window() const { return window_; }
  double smooth_window() const { return smooth_window_; }
  /// What should not have changed since t = 0, and what there is. Looks at every site.
  struct Balance {
    /// |energy + dissipated + outflow - supplied - by contacts - that at t = 0|, over the largest of them. Works are
    /// integrated level by level, but that of viscous friction alone over 200 samples or more.
    double energy_drift;
    double charge_error;  ///< charge less that at t = 0
    long dislocations;    ///< of either sign
    double steepest;      ///< largest difference of u between neighbouring sites
  };
  Balance balance() const;

  /// Slip events of a loaded chain so far, in the scenario's units. The stress drop is of the force F on a place, or of
  /// the stress at a pulled end.
  std::vector<Event> events() const;

  /// A sentence for each thing that is wrong or doubtful in the results so far: invariants that do not hold (energy,
  /// slip at x = 0 against the integral of the velocity there, dislocations that none of the ends explains, |W| <= k,
  /// fronts inside the domain and slower than c), a grid that holds slow dislocations, and too few dislocations. Above
  /// 1 % `go` ends with a NumericsError that says so.
  std::vector<std::string> warnings() const;

 private:
  struct Start {
    Problem problem;
    StaticTrain train;
  };
  static Start start(const ScaledProblem& scaled, double share_of_machine);
  static Start start(const ScaledProblem& scaled, const Execution& execution);
  Run(ScaledProblem scaled, output::Schedule schedule, const Execution& execution, const Start& start);
  double width_of_cell(std::size_t i) const;
  double middle_of_cell(std::size_t i) const;
  double centre_of_cell(std::size_t i) const;  ///< of the window for its slip, which stays on the chain
  bool proceed(const std::function<bool()>& interrupted);
  bool advance(const std::function<bool()>& interrupted);
  void look_at_start();
  void sample();
  void take();
  double driving_force() const;
  output::Snapshot profile_at(double time) const;
  double contact_at(double x) const;
  double pore_pressure_at_origin() const;
  void find_fronts(output::Snapshot& snapshot) const;
  output::Findings findings() const;
  void check_energy(const Balance& balance, output::Findings& findings) const;
  void check_slip(output::Findings& findings) const;
  void check_one_sign(const Balance& balance, output::Findings& findings) const;
  void check_fronts(output::Findings& findings) const;
  void check_barrier(output::Findings& findings) const;
  void refuse(const output::Findings& findings) const;

  ScaledProblem scaled_;
  output::Schedule schedule_;
  Chain chain_;
  double window_ = 0, smooth_window_ = 0;
  long work_every_ = 1;
  bool can_checkpoint_ = true;
  std::vector<output::Snapshot> snapshots_;
  std::optional<output::Findings> final_findings_;  ///< of a run that is finished
  // At t = 0.
  std::vector<double> first_u_;  ///< averages over the output cells
  double first_u_at_origin_ = 0, first_energy_ = 0, first_charge_ = 0;
  long first_dislocations_ = 0;
  double driving_force_ = 0;  ///< the largest on a dislocation, as a force F of the scenario
  Work work_;                 ///< since then, of viscous friction that the chain itself does not meter
  /// Integral of the velocity at x = 0 over the window of the slip. Its first sample is that of t = 0.
  output::SampledIntegral slip_{.samples = -1};
};

}  // namespace slipfront::chain
