#pragma once

#include <functional>
#include <vector>

#include "pulse/time/rates.hpp"

namespace slipfront::pulse {

/// One step in which friction is implicit, cell by cell, and all else explicit: ARS(4,4,3) (Ascher, Ruuth & Spiteri
/// 1997), of third order. Its difference from the implicit midpoint rule gives the error. Friction that balances a push
/// holds a cell through all stages, because the last stage is the result and no stage uses the force at the start.
class Ars443 {
 public:
  Ars443(std::size_t cells, std::size_t size);

  /// Lets friction act on all cells of the stage y for a time. Finds the momenta and the velocities after friction from
  /// the momenta `free` without it.
  using Friction =
      std::function<void(const double* y, const double* free, double time, double* momentum, double* velocity)>;

  /// Longest step, in units of the time in which a wave crosses a cell. With fluxes by fifth-order upwind differences,
  /// the explicit half is stable up to 1.27.
  static constexpr double longest_in_crossing_times = 1.1;

  /// y(t) -> y(t + dt). `rate_at_start` is f(t, y): all rates but those of friction.
  void operator()(const Rates& f, const Friction& friction, double t, double dt, std::vector<double>& y,
                  const std::vector<double>& rate_at_start);
  /// Error of the last step: the difference of the two solutions in units of `scale`, which has two entries per cell.
  /// It is the root mean square over the cells that are not `excluded` (1; 0 elsewhere).
  ///
  /// `friction_times` is the length of the step in friction times, for each cell. If it is large, friction balances the
  /// other forces at the end of the step. The midpoint rule does not damp, so its difference exaggerates the error of a
  /// momentum, and we divide it by the square of that length. However, the error of the mean momentum, which is that of
  /// slip, counts in full. We take its difference from the trapezoidal rule. It shows steps that the momentum begins
  /// far from its balance.
  double error(const std::vector<double>& y, const std::vector<double>& scale, const std::vector<double>& excluded,
               const std::vector<double>& friction_times) const;

 private:
  std::size_t cells_;
  std::vector<std::vector<double>> rates_;     ///< at the start and at each stage but the last, without friction
  std::vector<std::vector<double>> friction_;  ///< for each stage: loss of momentum by cell, then of energy
  std::vector<double> before_, stage_, midpoint_, free_, momentum_, velocity_;
  std::vector<double> mean_off_;  ///< mean momentum, less that of the trapezoidal rule
};

}  // namespace slipfront::pulse
