#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <functional>
#include <vector>

#include "slipfront/error.hpp"

namespace slipfront::pulse {

/// y' = f(t, y).
using Rates = std::function<void(double t, const double* y, double* dy)>;

/// The step to take where `dt` is wanted: steps end on the target exactly, and the last two share what remains, so that
/// none is a sliver.
inline double next_step(double remaining, double dt) {
  return dt >= remaining ? remaining : dt > remaining / 2 ? remaining / 2 : dt;
}

/// A step that fails however short it is.
NumericsError too_strong_forces(double time);

/// Whether a step has changed the rapidity of some cell by about a half or more, or has squeezed a cell to a tenth: a
/// dense train that runs into a sparse one, or a contact as steep as a wall. The error does not tell, as it leaves out
/// the cells near a shock.
bool cells_jump(const std::vector<double>& before, const std::vector<double>& after, const std::vector<double>& charge);

/// One step of SSPRK(5,4): explicit, fourth order, strong stability preserving up to 1.5 Euler steps (Spiteri & Ruuth
/// 2002), with a third-order solution beside it for the error.
class ExplicitStep {
 public:
  explicit ExplicitStep(std::size_t size);
  static constexpr double last_stage = 0.935010630967652;  ///< its time, in steps
  /// y(t) -> y(t + dt). `rate_at_start` is f(t, y), which the caller has already needed for the step size.
  void operator()(const Rates& f, double t, double dt, std::vector<double>& y,
                  const std::vector<double>& rate_at_start);
  /// Of the last step: the difference of the two solutions in units of `scale`, two entries a cell, root mean square
  /// over the cells that are not `excluded` (1; 0 elsewhere).
  double error(double dt, const std::vector<double>& rate_at_start, const std::vector<double>& scale,
               const std::vector<double>& excluded) const;
  /// Whether some stage of the last step has carried entry i from `before` through zero, to where its rate turns it
  /// back.
  bool returns_to_zero(std::size_t i, double before) const {
    const auto returns = [before](double u, double rate) { return before * u < 0 && before * rate > 0; };
    return returns(u1_[i], rate1_[i]) || returns(u2_[i], rate2_[i]) || returns(u3_[i], rate3_[i]) ||
           returns(u4_[i], rate4_[i]);
  }
  /// Largest rate of entry i in the stages of the last step.
  double largest_rate(std::size_t i) const {
    return std::max({std::fabs(rate1_[i]), std::fabs(rate2_[i]), std::fabs(rate3_[i]), std::fabs(rate4_[i])});
  }

 private:
  std::vector<double> u1_, u2_, u3_, u4_, rate1_, rate2_, rate3_, rate4_;
};

/// One step of Rodas4: linearly implicit, fourth order, L-stable, stiffly accurate (Hairer & Wanner 1996, IV.10), with
/// banded Jacobian by differences. y holds pairs, a width and a momentum, then entries that only add up: these by
/// Simpson's rule, with the step's own dense output in the middle. Linear systems are solved for places, the sums of
/// the widths, instead of the widths: a force that depends on the place couples a pair with all widths before it, but
/// only with the places beside it.
class ImplicitStep {
 public:
  /// Rates depend on `reach` entries to either side in the order: place, momentum, place, ...
  ImplicitStep(std::size_t pairs, std::size_t size, std::size_t reach, bool depends_on_time);
  /// Tries one step; returns the error in units of the tolerance (accept if <= 1) and leaves y(t + dt) in `next`.
  /// `scale[i]` is the size that width or momentum i is measured by. An error of momentum lasts for one friction time
  /// only, 1 / `friction_rate`, and counts for less in longer steps, though never less than a twentieth.
  double operator()(const Rates& f, double t, double dt, const std::vector<double>& y,
                    const std::vector<double>& rate_at_start, const std::vector<double>& scale, double friction_rate,
                    double tolerance, std::vector<double>& next);
  /// Evaluates the Jacobian at (t, y); valid for any number of tries from there. Momenta below the share `slow` of
  /// their scale have the slope from rest instead of that at y: friction that is steep at rest, like w^(1/2), is less
  /// steep at y, and a step by that slope would throw what creeps farther to the other side than it was.
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
  void to_places(const std::vector<double>& y);
  void to_widths(std::vector<double>& y) const;
  void add_sums(const Rates& f, double t, double dt, const std::vector<double>& y,
                const std::vector<double>& rate_at_start, std::vector<double>& next);

  std::size_t unknowns_, size_, reach_, stride_;
  bool depends_on_time_;
  std::vector<double> jacobian_, lu_, by_time_, work_, rate_, places_, places_before_;
  std::vector<double> u_[6];
};

}  // namespace slipfront::pulse
