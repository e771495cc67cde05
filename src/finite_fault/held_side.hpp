#pragma once
/// \file
/// One side of the hypocentre, where a load holds the stress until the pulse comes. Private to src/finite_fault.

#include <vector>

#include "pulse/solver.hpp"

namespace slipfront::finite_fault {

/// Smallest stress that the solver supports. Smaller values are treated as zero.
inline constexpr double least_stress = 0.005;

/// The stress (mu A / pi) at given distances from the hypocentre, which ascend from 0. The stress is linear between
/// them, and constant after the last.
struct SideStress {
  std::vector<double> distance, stress;
  double at(double distance) const;
};

/// One side on fine nodes, which extend as far as its front can come by the time `end`.
class HeldSide {
 public:
  HeldSide(SideStress stress, double end);
  /// The time at which the front comes to this distance. It moves with the local speed c0(psi) of Eq. 8, because the
  /// state ahead is at rest. The time is infinite if the stress is zero anywhere on the way.
  double front_time(double distance) const;
  /// The stressed side lies at x < 0. The load F(x) = p_x / k keeps it at rest: P_t + Q_x = F k with U = 0, Q = p.
  pulse::Problem problem() const;

 private:
  SideStress stress_;
  double length_ = 0, node_ = 0;         ///< distance of the last node, spacing of the nodes
  std::vector<double> pressure_, time_;  ///< pressure and front time at the nodes
};

}  // namespace slipfront::finite_fault
