#pragma once

#include <cstddef>
#include <vector>

#include "foundation/math/step_control.hpp"
#include "pulse/time/rates.hpp"

namespace slipfront::pulse {

/// Rodas4, a linearly implicit integrator of fourth order, L-stable and stiffly accurate (Hairer & Wanner 1996, Solving
/// Ordinary Differential Equations II, section IV.10), with a banded Jacobian by differences.
///
/// The vector y holds the widths of all cells, as many momenta, and then totals, on which no rate depends. The totals
/// follow by Simpson's rule, with the dense output of the step in the middle. Linear systems are solved for positions,
/// the sums of the widths, instead of the widths. A force that depends on the position couples a cell with all widths
/// before it, but only with the positions next to it. The order of the unknowns is position, momentum, position, ...,
/// which keeps the band narrow.
class Rodas4 {
 public:
  /// Rates depend on `reach` entries to either side in that order.
  Rodas4(std::size_t cells, std::size_t size, std::size_t reach, bool depends_on_time);

  /// Scales of the error. Entry i of `scale` is the size of width or momentum i. An error of momentum lasts for only
  /// one friction time, 1 / `friction_rate`. It therefore counts for less in longer steps, but never for less than a
  /// twentieth.
  struct Tolerance {
    const std::vector<double>& scale;
    double relative;
    double friction_rate = 0;
  };
  /// Attempts one step from y(t), with f(t, y) in `rate_at_start`, and leaves y(t + dt) in `next`.
  StepAttempt operator()(const Rates& f, double t, double dt, const std::vector<double>& y,
                         const std::vector<double>& rate_at_start, const Tolerance& tolerance,
                         std::vector<double>& next);

  /// Evaluates the Jacobian at (t, y), for any number of attempts from there. Momenta below the fraction `slow` of
  /// their scale get the slope from rest instead of that at y. Friction that is steep at rest, like w^(1/2), is less
  /// steep at y. A step with the slope at y would overshoot: a slow momentum would change its sign and grow.
  void linearise(const Rates& f, double t, const std::vector<double>& y, const std::vector<double>& rate,
                 const std::vector<double>& scale, double slow);

 private:
  void differentiate_by_time(const Rates& f, double t, double dt, const std::vector<double>& y,
                             const std::vector<double>& rate_at_start);
  void factorise(double diagonal);
  void solve(std::vector<double>& b);
  double& entry(std::vector<double>& m, std::size_t row, std::size_t column) const {
    return m[row * stride_ + (column + reach_ - row)];
  }
  bool is_position(std::size_t j) const { return j % 2 == 0; }
  /// Index in y of entry j of the banded order.
  std::size_t in_y(std::size_t j) const { return is_position(j) ? j / 2 : cells_ + j / 2; }
  void to_positions(const std::vector<double>& y);
  void to_widths(std::vector<double>& y) const;
  double nudge(std::size_t j, const std::vector<double>& y, const std::vector<double>& scale, double slow) const;
  StepAttempt attempt(double dt, const Tolerance& tolerance, const std::vector<double>& next) const;
  void add_sums(const Rates& f, double t, double dt, const std::vector<double>& y,
                const std::vector<double>& rate_at_start, std::vector<double>& next);

  std::size_t cells_, unknowns_, size_, reach_, stride_;
  bool depends_on_time_;
  std::vector<double> jacobian_, lu_, by_time_, work_, rate_, positions_, positions_before_;
  std::vector<double> u_[6];
};

}  // namespace slipfront::pulse
