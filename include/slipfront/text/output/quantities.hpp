#pragma once
/// \file
/// Declarations of the numbers of a run along a line. Files, tables, JSON, Python and the explorer are loops over them.
///
/// To add a number of a snapshot, add a member to Snapshot, its line to quantities.cpp, and set it where a run is
/// observed (pulse/observe, chain/run_observer.cpp). If it follows from the rest of a snapshot at every level of
/// theory, set it in complete(). Numbers of a whole run are declared in run.cpp of pulse, chain and plane.
///
/// Also the checks that a run makes of its own results: a list of the errors found, and the integral of a sampled
/// velocity with an estimate of its error.

#include <cmath>
#include <span>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "slipfront/description.hpp"
#include "slipfront/text/output/snapshot.hpp"

namespace slipfront::output {

/// The solvers that measure a number. Others have no value.
enum class MeasuredBy { all, pulse, chain };

/// A number of a snapshot.
struct Scalar {
  Description about;
  double (*get)(const Snapshot&);
  void (*set)(Snapshot&, double);
  MeasuredBy by = MeasuredBy::all;
  std::string_view heading = {};  ///< heading of its column in a comparison of levels; empty: it is not compared
};
std::span<const Scalar> scalars();

/// A value of a run. A double that is not finite means that the value is absent.
using Value = std::variant<double, long, std::string, std::vector<double>>;

enum class Kind { result, text, of_machine };

/// A number of a whole run, or a text. One `of_machine` depends on the machine, and not only on the scenario.
template <class Run>
struct Quantity {
  Description about;
  Value (*get)(const Run&);
  Kind kind = Kind::result;
  std::string_view (*unit)(const Run&) = nullptr;  ///< its unit, if that depends on the run
};

/// The time and the machine that a run took.
struct Spent {
  double stepping = 0, wall = 0;  ///< seconds of the run only, and of everything
  long steps = 0;                 ///< steps in these seconds
  int ranks = 1, threads = 1;
};

/// Descriptions that several solvers share.
inline constexpr Description time_axis = {"time", "time", "b / (c A)", "Eq. 3"};
inline constexpr Description end_time = {"time", "end of the run", "b / (c A)", "Eq. 3"};
inline constexpr Description step_count = {"steps", "number of time steps", "", ""};
inline constexpr Description wall_time = {"wall_seconds", "seconds of the whole command", "", ""};
inline constexpr Description scale_factor = {
    "scale", "scale of a chain: x and t are stretched by it, friction is divided by it", "", "Eq. 3", "no chain"};
inline constexpr Description slip_window = {"window", "averaging window of the slip at x = 0, of a chain", "b / A",
                                            "Eq. 5", "no chain"};
inline constexpr Description velocity_window = {
    "smooth_window", "averaging window of velocities and stresses at x = 0, of a chain", "b / A", "Eq. 5", "no chain"};

/// Sets the numbers that follow from the rest of a snapshot.
void complete(Snapshot& snapshot, const Schedule& schedule);

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
