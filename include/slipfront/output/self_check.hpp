#pragma once
/// \file
/// How a run checks itself: what it finds wrong in its own results, and the integral of a velocity that it samples on
/// its way, with an estimate of the error.

#include <cmath>
#include <string>
#include <vector>

namespace slipfront::output {

/// What a run finds wrong or doubtful in its own results: sentences for the user, and the worst violation among them.
struct Findings {
  static constexpr double worth_a_warning = 1e-3, wrong = 1e-2;  ///< relative sizes of a violation

  std::vector<std::string> sentences;
  std::string worst;
  double size = 0;

  void violation(double relative, const std::string& sentence) {
    if (relative <= worth_a_warning) return;  // NaN is a violation
    sentences.push_back(sentence);
    if (relative <= size) return;
    size = std::isnan(relative) ? HUGE_VAL : relative;
    worst = sentence;
  }
  bool wrong_results() const { return size > wrong; }
};

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
