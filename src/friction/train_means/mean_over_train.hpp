#pragma once

#include <cmath>

#include "slipfront/friction/law.hpp"

namespace slipfront::friction {

/// Steps of y and the end of the sum of `mean_over_train`. The default is enough for any smooth law, the error being
/// some exp(-pi^2 / step).
struct TailSum {
  double step = 1.0 / 8, end = 40;
};

/// Mean of a function of r, the slip velocity over the fastest, over a uniform train: over half a period, u / 2 from 0
/// to pi / 2, where
///     w = 2 a sinh |phi| sqrt(sinh^2 psi + sin^2(u / 2)).
/// With pi / 2 - u / 2 = gd(y), the scale psi at u = 0 becomes a decaying tail, and the trapezoidal rule converges
/// exponentially for smooth laws, however empty the train is. In y, du goes as sech y dy and dx as du / w. `s` is
/// tanh psi.
template <class Function>
double mean_over_train(double s, Closure closure, const TailSum& tail, const Function& function) {
  const bool over_slip = closure == Closure::consistent;
  const double decay = std::exp(-tail.step), end = over_slip ? tail.end : tail.end + std::log1p(1 / s);
  double sum = 0, weights = 0, e = 1;  // e = exp(-y)
  for (int i = 0; i * tail.step <= end; ++i, e *= decay) {
    const double sech = 2 * e / (1 + e * e), tanh = (1 - e * e) / (1 + e * e);
    const double r = std::hypot(sech, s * tanh);
    const double weight = (i == 0 ? 0.5 : 1) * (over_slip ? sech : sech / r);
    sum += weight * function(r);
    weights += weight;
  }
  return sum / weights;
}

}  // namespace slipfront::friction
