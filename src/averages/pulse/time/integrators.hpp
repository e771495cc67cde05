#pragma once

#include <cstddef>
#include <functional>
#include <vector>

#include "math/time_steps.hpp"

namespace slipfront::pulse {

/// y' = f(t, y).
using Rates = std::function<void(double t, const double* y, double* dy)>;

/// The semi-implicit Euler method, extrapolated once (Deuflhard 1985, SIAM Review 27:505): two steps of half the length
/// are compared with the whole step, and the difference added to them. Second order.
class ExtrapolatedEuler {
 public:
  /// One step of the first-order method, from y at t to `next` at t + dt.
  using Step = std::function<void(double t, double dt, const double* y, double* next)>;

  explicit ExtrapolatedEuler(std::size_t size) : whole_(size), half_(size), halves_(size) {}

  void operator()(const Step& step, double t, double dt, const std::vector<double>& y, std::vector<double>& next) {
    step(t, dt, y.data(), whole_.data());
    step(t, dt / 2, y.data(), half_.data());
    step(t + dt / 2, dt / 2, half_.data(), halves_.data());
    for (std::size_t i = 0; i < next.size(); ++i) next[i] = halves_[i] + difference(i);
  }
  /// Entry i after the two steps, and its difference from the whole step, which is an estimate of the error.
  double after_halves(std::size_t i) const { return halves_[i]; }
  double difference(std::size_t i) const { return halves_[i] - whole_[i]; }

 private:
  std::vector<double> whole_, half_, halves_;
};

/// SSPRK(5,4), an explicit integrator of fourth order that preserves strong stability up to 1.5 Euler steps (Spiteri &
/// Ruuth 2002, SIAM J. Numer. Anal. 40:469), with an embedded solution of third order for its error.
class Ssprk54 {
 public:
  explicit Ssprk54(std::size_t size);
  static constexpr double last_stage = 0.935010630967652;  ///< its time, in steps

  /// y(t) -> y(t + dt). `rate_at_start` is f(t, y), which the caller has already needed for the step size.
  void operator()(const Rates& f, double t, double dt, std::vector<double>& y,
                  const std::vector<double>& rate_at_start);

  /// Error of the last step: the root mean square over cells of the difference between the two solutions, in units of
  /// `scale`. The entries of cell i are i and cells + i. `weight` of a cell is 1 less its entry of `excluded`.
  double error(double dt, const std::vector<double>& rate_at_start, const std::vector<double>& scale,
               const std::vector<double>& excluded) const;

  /// Whether some stage of the last step has carried entry i from `before` through zero, to where its rate turns it
  /// back.
  bool returns_to_zero(std::size_t i, double before) const;
  /// Largest rate of entry i in the stages of the last step.
  double largest_rate(std::size_t i) const;

 private:
  std::vector<double> u1_, u2_, u3_, u4_, rate1_, rate2_, rate3_, rate4_;
};

/// One step in which friction is implicit, cell by cell, and all else explicit: ARS(4,4,3) (Ascher, Ruuth & Spiteri
/// 1997), of third order. Its difference from the implicit midpoint rule gives the error. Friction that balances a push
/// holds a cell through all stages, because the last stage is the result and no stage uses the force at the start.
class Ars443 {
 public:
  Ars443(std::size_t cells, std::size_t size);

  /// Lets friction act on all cells of the stage y for a time. Finds the momenta and the velocities after friction from
  /// the momenta `free` without it.
  using Friction =
      std::function<void(const double* y, const double* free, double time, double* momentum, double* velocity)>;

  /// Longest step, in units of the time in which a wave crosses a cell. With fluxes by fifth-order upwind differences,
  /// the explicit half is stable up to 1.27.
  static constexpr double longest_in_crossing_times = 1.1;

  /// y(t) -> y(t + dt). `rate_at_start` is f(t, y): all rates but those of friction.
  void operator()(const Rates& f, const Friction& friction, double t, double dt, std::vector<double>& y,
                  const std::vector<double>& rate_at_start);
  /// Error of the last step: the difference of the two solutions in units of `scale`, which has two entries per cell.
  /// It is the root mean square over the cells that are not `excluded` (1; 0 elsewhere).
  ///
  /// `friction_times` is the length of the step in friction times, for each cell. If it is large, friction balances the
  /// other forces at the end of the step. The midpoint rule does not damp, so its difference exaggerates the error of a
  /// momentum, and we divide it by the square of that length. However, the error of the mean momentum, which is that of
  /// slip, counts in full. We take its difference from the trapezoidal rule. It shows steps that the momentum begins
  /// far from its balance.
  double error(const std::vector<double>& y, const std::vector<double>& scale, const std::vector<double>& excluded,
               const std::vector<double>& friction_times) const;

 private:
  std::size_t cells_;
  std::vector<std::vector<double>> rates_;     ///< at the start and at each stage but the last, without friction
  std::vector<std::vector<double>> friction_;  ///< for each stage: loss of momentum by cell, then of energy
  std::vector<double> before_, stage_, midpoint_, free_, momentum_, velocity_;
  std::vector<double> mean_off_;  ///< mean momentum, less that of the trapezoidal rule
};

/// Rodas4, a linearly implicit integrator of fourth order, L-stable and stiffly accurate (Hairer & Wanner 1996, Solving
/// Ordinary Differential Equations II, section IV.10), with a banded Jacobian by differences.
///
/// The vector y holds the widths of all cells, as many momenta, and then totals, on which no rate depends. The totals
/// follow by Simpson's rule, with the dense output of the step in the middle. Linear systems are solved for positions,
/// the sums of the widths, instead of the widths. A force that depends on the position couples a cell with all widths
/// before it, but only with the positions next to it. The order of the unknowns is position, momentum, position, ...,
/// which keeps the band narrow.
class Rodas4 {
 public:
  /// Rates depend on `reach` entries to either side in that order.
  Rodas4(std::size_t cells, std::size_t size, std::size_t reach, bool depends_on_time);

  /// Scales of the error. Entry i of `scale` is the size of width or momentum i. An error of momentum lasts for only
  /// one friction time, 1 / `friction_rate`. It therefore counts for less in longer steps, but never for less than a
  /// twentieth.
  struct Tolerance {
    const std::vector<double>& scale;
    double relative;
    double friction_rate = 0;
  };
  /// Attempts one step from y(t), with f(t, y) in `rate_at_start`, and leaves y(t + dt) in `next`.
  StepAttempt operator()(const Rates& f, double t, double dt, const std::vector<double>& y,
                         const std::vector<double>& rate_at_start, const Tolerance& tolerance,
                         std::vector<double>& next);

  /// Evaluates the Jacobian at (t, y), for any number of attempts from there. Momenta below the fraction `slow` of
  /// their scale get the slope from rest instead of that at y. Friction that is steep at rest, like w^(1/2), is less
  /// steep at y. A step with the slope at y would overshoot: a slow momentum would change its sign and grow.
  void linearise(const Rates& f, double t, const std::vector<double>& y, const std::vector<double>& rate,
                 const std::vector<double>& scale, double slow);

 private:
  void differentiate_by_time(const Rates& f, double t, double dt, const std::vector<double>& y,
                             const std::vector<double>& rate_at_start);
  void factorise(double diagonal);
  void solve(std::vector<double>& b);
  double& entry(std::vector<double>& m, std::size_t row, std::size_t column) const {
    return m[row * stride_ + (column + reach_ - row)];
  }
  bool is_position(std::size_t j) const { return j % 2 == 0; }
  /// Index in y of entry j of the banded order.
  std::size_t in_y(std::size_t j) const { return is_position(j) ? j / 2 : cells_ + j / 2; }
  void to_positions(const std::vector<double>& y);
  void to_widths(std::vector<double>& y) const;
  double nudge(std::size_t j, const std::vector<double>& y, const std::vector<double>& scale, double slow) const;
  StepAttempt attempt(double dt, const Tolerance& tolerance, const std::vector<double>& next) const;
  void add_sums(const Rates& f, double t, double dt, const std::vector<double>& y,
                const std::vector<double>& rate_at_start, std::vector<double>& next);

  std::size_t cells_, unknowns_, size_, reach_, stride_;
  bool depends_on_time_;
  std::vector<double> jacobian_, lu_, by_time_, work_, rate_, positions_, positions_before_;
  std::vector<double> u_[6];
};

}  // namespace slipfront::pulse
