#pragma once
/// \file
/// The averaged equations on a fault plane, on a fixed grid: for ruptures of any shape, several of them, and lines that
/// walk around a barrier. A static load or friction may hold the initial state.

#include <memory>

#include "slipfront/plane/problem.hpp"

namespace slipfront::plane {

/// Follows the mean slip and the wave action in each cell of a grid. The rupture front is the contour of slip 0, which
/// lies between the centres of cells. Errors are of first order in the size of a cell.
class GridSolver : public Solver {
 public:
  /// `cells`: cells along x, at least 8. Those along y have nearly the same size. \throws InputError for an initial
  /// slip that is negative, not finite, or 0 everywhere; for friction that changes contacts; for fixed or absorbing
  /// edges where there is slip; and for a static load where the slip ends with a gradient above 0.7.
  GridSolver(const Problem& problem, int cells);
  ~GridSolver() override;

  const Problem& problem() const override;
  double time() const override;
  long steps() const override;
  /// \throws NumericsError also if the front reaches an edge, and if more than a tenth of the energy has come from
  /// nothing.
  bool advance_to(double time, const std::function<bool()>& interrupted) override;
  StepsAhead steps_ahead(double duration) const override;
  bool lines_have_met() const override;

  std::vector<double> slip(const std::vector<Point>& points) const override;
  std::vector<double> velocity(const std::vector<Point>& points) const override;
  Field field(int nx, int ny) const override;
  std::vector<Line> lines() const override;
  double potency() const override;
  double potency_rate() const override;
  double front(double y_scale) const override;
  Energies energies() const override;
  double least_energy() const override;
  std::vector<std::string> warnings() const override;

  void archive(Archive& a) override;

 private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

}  // namespace slipfront::plane
