#pragma once

namespace slipfront {

/// SSPRK(3,3), the explicit integrator of third order that preserves strong stability up to one Euler step (Shu & Osher
/// 1988, J. Comput. Phys. 77:439). Each stage sets y to of_old y_old + (1 - of_old) (y + step rates(t, y)), where y_old
/// is the start of the step. Calls stage(t, step, of_old) for each.
template <class Stage>
void ssprk3(double t, double step, const Stage& stage) {
  stage(t, step, 0.0);
  stage(t + step, step, 0.75);
  stage(t + step / 2, step, 1.0 / 3);
}

}  // namespace slipfront
