#pragma once
/// \file
/// Runs a chain for a scenario. The run multiplies x and t by a scale and divides friction by it (docs/chain.md), but
/// reports its results in the scenario's units. It makes the same kind of snapshots as a pulse run. A run that is saved
/// and continued gives the same results, to the last bit.

#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "slipfront/lattice/chain/chain.hpp"
#include "slipfront/text/output/dislocation_paths.hpp"
#include "slipfront/text/output/quantities.hpp"
#include "slipfront/text/output/run.hpp"
#include "slipfront/text/output/snapshot.hpp"

namespace slipfront::chain {

/// A problem in the scenario's units.
struct ScaledProblem {
  double scale = 1;                                   ///< factor by which x and t are multiplied
  double left = -1, right = 1;                        ///< the domain, in the scenario's x
  std::function<double(double)> stress;               ///< initial stress at x; all is at rest at the start
  std::function<double(double x, double t)> forcing;  ///< F; null: none
  bool steady_forcing = false;                        ///< F does not depend on t
  double end = 0;  ///< time until which F is sampled and contacts age, to choose the step; 0: assume a strong F
  std::function<double(double)> contact;  ///< a(x) at t = 0; null: 1
  friction::Friction friction;            ///< the scenario's friction; its closure is not used
  Boundary boundary;
  Model model = Model::sine_gordon;
  double spacing = default_spacing;  ///< spacing of the grid or lattice, in the chain's own (scaled) x
  Loading loading = {};              ///< in the scenario's units
  bool substrate = true;             ///< see Problem, like the next three
  bool implicit = false;
  bool phases_of_32_bits = false;
  double tolerance = 5e-5;
  double step = 0;  ///< time step, in the chain's own t; 0: chosen_step
  /// Width of the averages at x = 0, in the scenario's x. With 0, the slip is averaged over one spacing of the denser
  /// train next to x = 0. Velocity and stress are averaged over eight, or over up to eight of the other train.
  double window = 0;
};

/// Converts a problem to the chain's own units and checks it. `share_of_machine` is the part of the chain that runs on
/// this machine. \throws InputError as check does.
Problem problem_of(const ScaledProblem& scaled, double share_of_machine = 1);

/// Errors of the quantities that a run conserves, and the present dislocations.
struct Balance {
  /// |energy + dissipated + outflow - supplied - by_contacts - energy at t = 0|, divided by the largest of these terms.
  /// The run integrates work at every level. If viscous friction is the only force on a long chain, it integrates over
  /// 200 samples or more.
  double energy_drift;
  double charge_error;  ///< charge minus charge at t = 0
  long dislocations;    ///< number of dislocations and antidislocations
  double steepest;      ///< largest difference of u between neighbouring sites
};

/// Averages of velocity and stress at the end, over the windows that show the beat of trains and the shape of the pulse
/// least (best_average). The errors compare windows of other widths.
struct Averages {
  double width;           ///< width of the window at x = 0, in the scenario's x
  double velocity_error;  ///< error of the slip velocity at x = 0
  double stress_error;    ///< error of the stress there
  double peak_error;      ///< error of the largest slip velocity
};

class EventOutputs;
class RunObserver;

class Run : public output::Run {
 public:
  Run(const ScaledProblem& scaled, output::Schedule schedule, const Execution& execution);
  /// Continues a saved run. \throws InputError if another scenario was saved.
  Run(const ScaledProblem& scaled, output::Schedule schedule, const Execution& execution, std::string_view saved,
      std::vector<output::Snapshot> snapshots);
  ~Run() override;
  Run(const Run&) = delete;
  Run& operator=(const Run&) = delete;

  /// It calls `interrupted` about every tenth of a second.
  bool go(const std::function<bool()>& interrupted = {}) override;

  const Chain& chain() const { return *chain_; }
  const output::Schedule& schedule() const { return schedule_; }
  /// Snapshots of the output times and, between them, those of slip events that the schedule asks for.
  const std::vector<output::Snapshot>& snapshots() const;
  bool can_checkpoint() const override { return chain_->valid(); }
  bool finished() const override;
  void archive(Archive& a) override;

  double time() const override { return chain_->time() / scale_; }  ///< in the scenario's units
  long steps() const override { return chain_->steps(); }
  double scale() const { return scale_; }
  std::vector<double> sites() const;           ///< positions of the sites, in the scenario's x
  output::PathSettings path_settings() const;  ///< how to follow its dislocations
  /// Width of the average of the slip at x = 0, a box, in the scenario's x.
  double window() const;
  /// (all) The averages of the last snapshot. Those of profiles have windows of at least two output cells.
  Averages averages() const;
  /// (all) Reads every site.
  Balance balance() const;

  /// The slip events of a loaded chain so far, in the scenario's units. Their stress drop is the drop of the force F on
  /// a site, or of the stress at a pulled end.
  std::vector<output::SlipEvent> events() const;
  /// When they arrived at the positions that the scenario asks for.
  output::FrontRecords fronts() const;

  /// Returns a sentence for each wrong or doubtful result so far. The run checks energy, slip at x = 0 against the
  /// integral of the velocity there, and the number of dislocations against the charge of the ends. It also checks that
  /// |W| <= k, and that fronts are inside the domain and slower than c. It warns of a grid that holds slow
  /// dislocations, and of too few dislocations. If an error is above 1 %, `go` throws a NumericsError that states the
  /// reason.
  std::vector<std::string> warnings() const override;

 private:
  bool advance_to(double time, const std::function<bool()>& interrupted);
  void refuse_wrong(const output::Findings& findings) const;

  double scale_;
  output::Schedule schedule_;
  std::unique_ptr<Chain> chain_;
  std::unique_ptr<RunObserver> observer_;
  std::unique_ptr<EventOutputs> outputs_;
  std::optional<output::Findings> final_findings_;  ///< set when the run is finished
};

/// A run that has reached its end, and how it was run.
struct Report {
  const Run& run;
  Balance balance;    ///< result of run.balance(), in which all ranks take part
  Averages averages;  ///< result of run.averages(), like `balance`
  output::Spent spent;
};
/// The numbers of a run that its snapshots do not have.
std::span<const output::Quantity<Report>> quantities();

}  // namespace slipfront::chain
