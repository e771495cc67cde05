#pragma once

#include <functional>
#include <vector>

#include "pulse/time/rates.hpp"

namespace slipfront::pulse {

/// One step in which friction is implicit, cell by cell, and all else explicit: ARS(4,4,3) (Ascher, Ruuth & Spiteri
/// 1997), third order, with the implicit midpoint rule beside it for the error. Friction that balances a push holds a
/// cell through all stages, for the last one is the result and no stage asks for the force at the start.
class Ars443 {
 public:
  Ars443(std::size_t cells, std::size_t size);

  /// Friction on all cells of the stage y for a time: from the momenta `free` that they would have without it, those
  /// that it leaves and the velocities.
  using Friction =
      std::function<void(const double* y, const double* free, double time, double* momentum, double* velocity)>;

  /// Waves may cross this part of a cell in a step: with fluxes by fifth-order upwind differences its explicit half is
  /// stable up to 1.27.
  static constexpr double longest_in_crossing_times = 1.1;

  /// y(t) -> y(t + dt). `rate_at_start` is f(t, y): all rates but those of friction.
  void operator()(const Rates& f, const Friction& friction, double t, double dt, std::vector<double>& y,
                  const std::vector<double>& rate_at_start);
  /// Of the last step: the difference of the two solutions in units of `scale`, two entries a cell, root mean square
  /// over the cells that are not `excluded` (1; 0 elsewhere).
  double error(const std::vector<double>& y, const std::vector<double>& scale,
               const std::vector<double>& excluded) const;

 private:
  std::size_t cells_;
  std::vector<std::vector<double>> rates_;     ///< at the start and at each stage but the last, without friction
  std::vector<std::vector<double>> friction_;  ///< of each stage: loss of momentum by cell, then of energy
  std::vector<double> before_, stage_, midpoint_, free_, momentum_, velocity_;
};

}  // namespace slipfront::pulse
