#pragma once

#include <cstddef>
#include <vector>

#include "pulse/time/rates.hpp"

namespace slipfront::pulse {

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

}  // namespace slipfront::pulse
