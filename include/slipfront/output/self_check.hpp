#pragma once
/// \file
/// Checks that a run makes of its own results: a list of the errors found, and the integral of a sampled velocity with
/// an estimate of its error.

#include <cmath>
#include <string>
#include <vector>

namespace slipfront::output {

/// Errors and doubts that a run finds in its own results: sentences for the user, and the largest violation among them.
struct Findings {
  static constexpr double worth_a_warning = 1e-3, wrong = 1e-2;  ///< relative sizes of a violation

  std::vector<std::string> sentences;
  std::string worst;
  double size = 0;

  void violation(double relative, const std::string& sentence) {
    if (relative <= worth_a_warning) return;  // false for NaN, which counts as a violation
    sentences.push_back(sentence);
    if (relative <= size) return;
    size = std::isnan(relative) ? HUGE_VAL : relative;
    worst = sentence;
  }
  bool wrong_results() const { return size > wrong; }
};

/// Integral over time by the trapezoidal rule, once with all samples and once with every other sample. Slow changes
/// show as the difference of the two sums. Waves faster than the samples show in the scatter of the samples.
struct SampledIntegral {
  double time = 0, velocity = 0;  ///< time and velocity of the last sample
  double integral = 0;
  double early_time = 0, early_velocity = 0;  ///< time and velocity of the last sample in the coarse sum
  double coarse_integral = 0;
  double spread = 0;  ///< sum of squares of the uncertainties of the intervals between samples
  long samples = 0;   ///< number of samples after t = 0

  void archive(auto& a) { a(time, velocity, integral, early_time, early_velocity, coarse_integral, spread, samples); }

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
  /// The integral up to `now`, a time after the last sample.
  double up_to(double now, double velocity_now) const {
    return integral + (now - time) * (velocity_now + velocity) / 2;
  }
  /// Estimated error of the integral because of the finite number of samples.
  double error() const { return std::fabs(integral - coarse_integral) + std::sqrt(spread); }
};

}  // namespace slipfront::output
