#pragma once
/// \file
/// Every dislocation line of a fault plane: the sine-Gordon equation in two dimensions.

#include <memory>
#include <string>
#include <vector>

#include "slipfront/plane/problem.hpp"

namespace slipfront {
class Ranks;
}

namespace slipfront::plane {

struct DirectOptions {
  double scale = 1;      ///< factor by which x, y and t are stretched and friction is divided: as many times the lines
  double spacing = 0.4;  ///< largest spacing of the sites, in widths of a dislocation of the largest contact ratio
  int threads = 1;
  /// The processes that share the sites, each a band of rows; null: one process. They must outlive the solver, and all
  /// of them must make the same calls. All get the same results, to the last bit those of one process, but only the
  /// first one gets lines and the saved state.
  const Ranks* ranks = nullptr;
};

/// Approximate number of bytes that a solver needs, on all ranks together. \throws InputError for numbers out of range.
double memory_of_direct(const Problem& problem, const DirectOptions& options);

/// In one process: the largest force on the lines at t = 0 without friction, static load and F, as mean over each of nx
/// times ny cells: friction must be at least as strong to hold the initial state. \throws InputError as a solver.
double largest_unbalanced_force(const Problem& problem, const DirectOptions& options, int nx, int ny);

/// Solves the equation of every line on a grid, with fourth order in space and time. The edges of the domain are those
/// of the problem. Results are in the units of the scenario: slip, lengths and times are divided by the scale. Slip at
/// a point is the mean over a square whose half width is one spacing of the densest lines at the start. The elastic
/// energy is that of slopes and substrate, and the kinetic energy that of u_t: the averaged solver divides the same sum
/// in another way.
class DirectSolver : public Solver {
 public:
  /// \throws InputError for lines too dense for the spacing, for friction that changes contacts, for numbers out of
  /// range, and for more ranks than a fourth of the rows of sites.
  DirectSolver(const Problem& problem, const DirectOptions& options);
  ~DirectSolver() override;

  const Problem& problem() const override;
  double time() const override;
  long steps() const override;
  /// \throws NumericsError also if more than a tenth of the energy has come from nothing.
  bool advance_to(double time, const std::function<bool()>& interrupted) override;
  bool steps_end_on_time() const override { return false; }

  std::vector<double> slip(const std::vector<Point>& points) const override;
  std::vector<double> velocity(const std::vector<Point>& points) const override;
  Field field(int nx, int ny) const override;
  std::vector<Line> lines() const override;
  double potency() const override;
  double potency_rate() const override;
  double front(double y_scale) const override;
  Energies energies() const override;

  void archive(Archive& a) override;

  std::size_t sites() const;

 private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

}  // namespace slipfront::plane
