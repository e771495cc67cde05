#pragma once
/// \file
/// The integral of a velocity that a run samples on its way, and how far it may be from the truth.

#include <cmath>

namespace slipfront::output {

/// Integral over time by the trapezoidal rule over samples, and over every other of them: slow errors of the sum show
/// as the difference of the two, and waves faster than the samples by the spread of the samples.
struct SampledIntegral {
  double time = 0, velocity = 0;  ///< of the last sample
  double integral = 0;
  double early_time = 0, early_velocity = 0;  ///< of the last sample that the coarse sum has
  double coarse_integral = 0;
  double spread = 0;  ///< sum of squares of what each sample leaves open
  long samples = 0;   ///< behind t = 0

  void add(double now, double velocity_now) {
    const double elapsed = now - time, change = elapsed * (velocity_now - velocity) / 2;
    spread += change * change;
    integral += elapsed * (velocity_now + velocity) / 2;
    if (++samples % 2 == 0) {
      coarse_integral += (now - early_time) * (velocity_now + early_velocity) / 2;
      early_time = now;
      early_velocity = velocity_now;
    }
    time = now;
    velocity = velocity_now;
  }
  /// The integral up to a time behind the last sample.
  double up_to(double now, double velocity_now) const {
    return integral + (now - time) * (velocity_now + velocity) / 2;
  }
  /// How far it is from the truth, about, for the samples that it is made of.
  double error() const { return std::fabs(integral - coarse_integral) + std::sqrt(spread); }
};

}  // namespace slipfront::output
