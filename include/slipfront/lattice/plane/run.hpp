#pragma once
/// \file
/// One run on a plane, by either solver: its maps, its series over time, and its snapshots so far. A run can be saved
/// after any step. The resumed run gives bitwise identical results.

#include <functional>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "slipfront/lattice/plane/problem.hpp"
#include "slipfront/text/output/run.hpp"

namespace slipfront::plane {

/// When and where a run is observed.
struct Schedule {
  std::vector<double> times;      ///< ascending, from 0: one snapshot each
  int nx = 0, ny = 0;             ///< cells of the maps and snapshots
  double interval = 0;            ///< time between two rows of the series
  double rupture_slip = 0;        ///< a cell has ruptured when its slip, of either sign, exceeds this
  std::string rupture_rule = {};  ///< this slip in words
  /// y of the results over y of the problem: the speed of waves along y over that along x.
  double wave_speed_ratio = 1;
  bool lines = false;              ///< whether snapshots have the dislocation lines
  std::vector<Point> probes = {};  ///< points whose slip and slip velocity are numbers of the run
};

/// Approximate number of bytes of the snapshots and maps of a run.
double memory_of_results(const Schedule& schedule);

/// Numbers of the whole plane at one time, in the coordinates of the results.
struct SeriesRow {
  double time = 0;
  double potency = 0, potency_rate = 0;
  double peak_slip_velocity = 0;  ///< largest of the cells at this time
  /// Largest distance of the outermost dislocation line from the origin. With nucleation, that of a cell that has
  /// ruptured.
  double front = 0;
  Energies energies;
};

/// Values of the cells, row by row from the bottom (source_parameters.hpp defines them).
struct Maps {
  std::vector<double> rupture_time;        ///< NaN where the interface has not ruptured
  std::vector<double> rupture_velocity;    ///< NaN if it is not known
  std::vector<double> peak_slip_velocity;  ///< largest so far
  std::vector<double> rise_time;           ///< so far; NaN where there is no slip
  std::vector<double> initial_stress;      ///< at t = 0
  std::vector<double> final_stress;        ///< at the last row of the series
  std::vector<double> slip;                ///< at the last row of the series
};

class Run : public output::Run {
 public:
  Run(std::unique_ptr<Solver> solver, Schedule schedule);
  /// Resumes a saved run. `snapshots` are those before it was saved. The schedule may end later; the results are then
  /// those of one run to the later end. \throws InputError if the run was saved for another problem or schedule.
  Run(std::unique_ptr<Solver> solver, Schedule schedule, std::string_view saved, std::vector<Field> snapshots);

  /// It calls `interrupted` after every step. \throws NumericsError if the solver fails, if the run needs far more
  /// steps than waves do, and at the end if nine tenths of the energy are missing.
  bool go(const std::function<bool()>& interrupted = {}) override;

  const Solver& solver() const { return *solver_; }
  double time() const override { return solver_->time(); }
  long steps() const override { return solver_->steps(); }
  const Schedule& schedule() const { return schedule_; }
  const std::vector<Field>& snapshots() const { return snapshots_; }
  const std::vector<SeriesRow>& series() const { return seen_.series; }
  Maps maps() const;
  bool finished() const override { return snapshots_.size() == schedule_.times.size(); }
  std::vector<std::string> warnings() const override;
  void archive(Archive& a) override;

 private:
  /// The results so far, apart from snapshots.
  struct Seen {
    std::vector<SeriesRow> series = {};
    // Values of the cells.
    std::vector<double> rupture_time = {}, peak_slip_velocity = {};
    std::vector<double> velocity_squared = {};  ///< integral over time
    std::vector<double> last_slip = {};         ///< at the last row of the series
    long rows_on_time = 0;                      ///< rows of the series at multiples of the interval

    void archive(Archive& a);
  };

  void observe(bool snapshot);
  double farthest_rupture() const;
  void require_steps() const;
  void require_energy() const;

  std::unique_ptr<Solver> solver_;
  Schedule schedule_;
  std::vector<Field> snapshots_;
  Seen seen_;
  double expected_steps_ = 0;  ///< steps of the whole run; 0: their length is constant
  /// The last state that does not depend on the end of the run: that of the solver, empty if its steps do not depend on
  /// the schedule, and the results so far. A run to a later end continues from here.
  std::string before_end_;
};

}  // namespace slipfront::plane
