#pragma once
/// \file
/// The front that an observer sees, and the stress drop, of a pulse with viscous friction. Both depend on Sigma- and
/// the damping number Gamma = C T only, and come from a table made with the pulse solver (docs/friction_ratio.md), for
/// a true step of stress into the empty interface.

#include <array>
#include <vector>

#include "slipfront/friction_ratio/table.hpp"

namespace slipfront::friction_ratio {

/// The ratio of a FrontCurve as a function of Sigma- at one damping number.
class FrontAtDamping {
 public:
  /// The ratio for `stress` = Sigma- in 0.05 ... 3. \throws InputError if it is out of range.
  Ratio operator()(double stress) const;

 private:
  friend class FrontCurve;
  double damping_ = 0;
  std::array<double, 9> value_{}, slope_{};  ///< coefficients of polynomials in Sigma-, and their slopes by Gamma
};

/// The observed trailing front at one threshold: |x_front(T)| / (|V-| T), which is at most 1. x_front is the farthest
/// x < 0 at which W reaches the threshold times the peak of W at time T (`Measure::peak`). Make one object and call it
/// many times: the constructor does the interpolation in the threshold.
class FrontCurve {
 public:
  /// Takes a `threshold` in 1e-4 ... 0.3. \throws InputError if it is out of range.
  FrontCurve(friction::Closure closure, double threshold);
  /// The ratio for `stress` = Sigma- in 0.05 ... 3 and `damping_number` >= 0. Above 1e8 it falls as Gamma^(-1/2).
  /// \throws InputError if an argument is out of range.
  Ratio operator()(double stress, double damping_number) const { return at_damping(damping_number)(stress); }
  /// The ratio at this damping number, for calls with many values of Sigma-.
  FrontAtDamping at_damping(double damping_number) const;

 private:
  std::vector<double> coefficients_;  ///< those of polynomials in Sigma- and Gamma
};

/// Makes a FrontCurve and calls it once.
Ratio front_ratio(friction::Closure closure, double stress, double damping_number, double threshold);

/// Relative error of the front ratio: 1e-3 for closure "consistent" and 5e-3 for "paper". For "paper" and
/// 3 < Gamma < 1e5, where it is unstable, it is 3e-2.
double front_uncertainty(friction::Closure closure, double damping_number);

/// The range of thresholds that the table covers.
struct ThresholdRange {
  double least, most;
};
ThresholdRange threshold_range();

/// Which static stress drop of the pulse at time T.
enum class Drop {
  origin,  ///< Sigma- - Sigma(0), at x = 0
  mean,    ///< weighted with slip over the stressed side: integral of (Sigma- - Sigma) slip dx / integral of slip dx
};

/// The stress drop over Sigma-, for the same arguments as FrontCurve. It is constant above a damping number of 1e8.
/// \throws InputError if an argument is out of range.
Ratio stress_drop_share(Drop drop, friction::Closure closure, double stress, double damping_number);

/// Relative error of the share: 1e-3, but 1e-2 for closure "paper" and 3 < Gamma < 1e5.
double stress_drop_uncertainty(friction::Closure closure, double damping_number);

}  // namespace slipfront::friction_ratio
