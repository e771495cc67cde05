#pragma once
/// \file
/// The averaged equations on a fault plane, for star-shaped ruptures. On a plane, dislocations are lines. A bent line
/// has a tension, which slows a rupture.

#include <memory>

#include "slipfront/plane/problem.hpp"

namespace slipfront::plane {

/// Numbers of cells of the averaged solver.
struct Resolution {
  int loops = 60;    ///< cells along the label q, which counts dislocation lines from the outside inwards
  int angles = 128;  ///< directions around the origin; 1: all directions are equal (rings)
};

/// Follows the closed dislocation lines around the origin, as distances r(angle, label). All lines must be star-shaped:
/// each direction from the origin crosses each line once.
class AveragedSolver : public Solver {
 public:
  /// \throws InputError for an initial slip whose contours are not star-shaped, or that does not vanish inside the
  /// domain; for a held region that is not around the origin; for fewer than 4 loops, or 2 to 7 angles; and for
  /// friction with state variables, or with strength at rest.
  AveragedSolver(const Problem& problem, const Resolution& resolution);
  ~AveragedSolver() override;

  const Problem& problem() const override;
  double time() const override;
  long steps() const override;
  /// \throws NumericsError also if friction has taken more energy than the lines released, by more than a tenth.
  bool advance_to(double time, const std::function<bool()>& interrupted) override;
  StepsAhead steps_ahead(double duration) const override;

  std::vector<double> slip(const std::vector<Point>& points) const override;
  std::vector<double> velocity(const std::vector<Point>& points) const override;
  Field field(int nx, int ny) const override;
  std::vector<Line> lines() const override;
  double potency() const override;
  double potency_rate() const override;
  double front(double y_scale) const override;
  Energies energies() const override;
  std::vector<std::string> warnings() const override;

  void archive(Archive& a) override;

 private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

}  // namespace slipfront::plane
