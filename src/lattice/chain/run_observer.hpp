#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <vector>

#include "lattice/chain/observe/averages.hpp"
#include "lattice/chain/observe/totals.hpp"
#include "slipfront/lattice/chain/run.hpp"
#include "slipfront/text/output/snapshot.hpp"
#include "system/archive.hpp"

namespace slipfront::chain {

/// Measures the chain of a run in the scenario's units, and compares it with its state at t = 0.
class RunObserver {
 public:
  /// Observes a chain, which must be at t = 0 and must outlive the observer.
  RunObserver(const ScaledProblem& scaled, const output::Schedule& schedule, const Chain& chain);

  const ScaledProblem& scaled() const { return scaled_; }
  const output::Schedule& schedule() const { return schedule_; }
  const Chain& chain() const { return chain_; }
  double window() const { return window_; }
  double smooth_window() const { return smooth_window_; }
  /// (all) The averages of the last snapshot, of which `peak` is the position of its largest slip velocity.
  Averages averages(double time, double peak) const;

  /// The number of steps to the next sample.
  long steps_to_sample() const;
  /// Samples the velocity that is integrated over time.
  void sample();
  /// Returns a snapshot at `time` of the scenario, which the chain must have reached. \throws NumericsError if the
  /// chain has diverged.
  output::Snapshot snapshot(double time) const;
  Balance balance() const;

  /// The charge and the number of dislocations at t = 0, for checks.
  double charge_at_start() const { return first_charge_; }
  long dislocations_at_start() const { return first_dislocations_; }
  /// The largest force on a dislocation at t = 0, as a force F of the scenario.
  double driving_force_at_start() const { return driving_force_; }
  /// Whether the window at x = 0 is inside the domain.
  bool sees_origin() const;
  /// Slip at x = 0 on the chain, in its own units, from the displacement and from the sampled velocity.
  struct OriginSlip {
    double by_displacement, by_velocity, error;  ///< `error` is that of the integral of the velocity
    long samples;
  };
  OriginSlip origin_slip() const;

  void archive(Archive& a) { a(slip_); }

 private:
  void choose_windows();
  double width_of_cell(std::size_t i) const;
  double last_site() const;
  double middle_of_cell(std::size_t i) const;
  double centre_of_cell(std::size_t i) const;  ///< centre of the window of its slip, which must not leave the chain
  /// The widths of the average around the middle of cell i.
  double least_width(std::size_t i) const;
  BestAverage average_at_origin(const Sites& sites, double time) const;
  void widen_errors(Averages& averages, double time) const;
  /// The means over the window of the slip of a cell, and over that of the least width for its velocity and stress. A
  /// short chain keeps those of all cells.
  struct CellMeans {
    SiteWeights slip, smooth;
  };
  CellMeans means_of_cell(std::size_t i) const;
  /// Returns the slip velocities of windows of the least width, in which observers look for fronts.
  std::vector<double> add_profile(const Sites& sites, output::Snapshot& snapshot, double time) const;
  void add_origin(const Sites& sites, output::Snapshot& snapshot, double time) const;
  void add_energy(output::Snapshot& snapshot, const Totals& now) const;
  void add_sites(output::Snapshot& snapshot, double time) const;
  const Totals& totals_now() const;
  void find_fronts(output::Snapshot& snapshot, const Totals& now, const std::vector<double>& velocities) const;
  double contact_at(double x) const;
  double pore_pressure_at_origin() const;

  ScaledProblem scaled_;
  output::Schedule schedule_;
  const Chain& chain_;
  /// Widths of the windows: of slip, and of velocity and stress. Where two trains meet, that of velocity and stress is
  /// the best of those from smooth_window_ to widest_window_.
  double window_ = 0, smooth_window_ = 0, widest_window_ = 0;
  double densest_ = 0;  ///< the smaller spacing of the trains on either side of x = 0
  std::vector<CellMeans> means_;
  // Values at t = 0.
  std::vector<double> first_u_;  ///< averages over the output cells
  double first_u_at_origin_ = 0, first_energy_ = 0, first_charge_ = 0;
  long first_dislocations_ = 0;
  double driving_force_ = 0;
  mutable std::optional<Totals> totals_;  ///< at the last time for which they were needed
  /// Time integral of the velocity at x = 0, averaged over the window of the slip. Its first sample is at t = 0.
  output::SampledIntegral slip_{.samples = -1};
};

}  // namespace slipfront::chain
