#pragma once
/// \file
/// One side of the hypocentre: stress that a load holds until the pulse comes. Private to src/finite_fault.

#include <vector>

#include "pulse/solver.hpp"

namespace slipfront::finite_fault {

/// What the solver bears; less counts as none.
inline constexpr double least_stress = 0.005;

/// Places and stresses (mu A / pi) by their distance from the hypocentre: ascending, the first at 0. Linear between
/// them, constant beyond.
struct SideStress {
  std::vector<double> distance, stress;
  double at(double distance) const;
};

/// Fine nodes along one side, out to where its front can be by `end`.
class HeldSide {
 public:
  HeldSide(SideStress stress, double end);
  /// When the front comes to this distance, at the local speed of the closed form, c0(psi) (Eq. 8): the state ahead is
  /// at rest. Infinite beyond an unstressed place.
  double front_time(double distance) const;
  /// The stressed side lies at x < 0. The load F(x) = p_x / k keeps it at rest: P_t + Q_x = F k with U = 0, Q = p.
  pulse::Problem problem() const;

 private:
  SideStress stress_;
  double length_ = 0, node_ = 0;         ///< last distance, spacing of the nodes
  std::vector<double> pressure_, time_;  ///< at the nodes
};

}  // namespace slipfront::finite_fault
