#pragma once

#include <atomic>
#include <cmath>
#include <cstddef>
#include <deque>
#include <mutex>
#include <vector>

#include "friction/train_means/chebyshev.hpp"
#include "slipfront/friction/law.hpp"

namespace slipfront::friction {

/// Positions at which a law's force is evaluated for its mean over a train. They are equal steps of phase from one
/// dislocation to half way to the next. The slip velocity at a node, over the fastest, is r = dn, which is periodic and
/// smooth in phase. The sum over n steps therefore converges exponentially, as exp(-2 pi n K' / K). Three descending
/// Landen transformations give dn. Each is a rational function of the next, and after the last the angle equals its
/// phase.
class PhaseNodes {
 public:
  static constexpr std::size_t most = 64;  ///< trains at once
  static constexpr double least_s = 1e-12;
  static constexpr std::size_t most_steps = 90;  ///< needed at s = least_s
  /// The number of steps is rounded up to one of this many values, or kinds. `kind_of` returns the kind that a train
  /// with this s = tanh psi needs. Trains whose means are computed together should be of one kind; then no mean depends
  /// on the other trains.
  static constexpr std::size_t kinds = 15;
  static std::size_t kind_of(double s);
  /// Nodes for `size` <= `most` trains with these s = tanh psi. Values below least_s count as least_s.
  PhaseNodes(std::size_t size, const double* s);
  std::size_t count() const { return steps_ + 1; }
  /// Computes r at node k < count() in each train, and the weight of the node in the mean over slip or over length.
  void node(std::size_t k, Closure closure, double* r, double* weight) const;

 private:
  std::size_t size_, steps_;
  double squared_sine_[most_steps + 1];              ///< sin^2 of the angle after the last transformation
  double third_[most], second_[most], first_[most];  ///< coefficients of the three transformations
};

/// Computes the means of the forces that `loops` returns, to 1e-10 if the forces are smooth in ln w.
void means_by_phase(const ForceLoops& loops, const Trains& trains, Closure closure, double* mean);

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

/// The mean over slip of a law without state, as polynomials in the logarithms of the fastest slip velocity and of
/// s = tanh psi. A patch is made when a train first lies in it, from 64 means, and is kept only if it is as good as
/// those between its nodes too. Where the law has a kink, outside the patches, and with closure "paper" quadrature
/// finds each mean. Threads may share it.
class TabulatedAverage : public QuadratureAverage {
 public:
  using QuadratureAverage::QuadratureAverage;
  void mean_strengths(const Trains& trains, Closure closure, double* mean, double* slope) const override;

 private:
  struct Patch {
    ChebyshevPatch polynomial;
    bool good;
  };
  /// Null where polynomials are not precise enough.
  const ChebyshevPatch* good_patch(std::size_t row, std::size_t column) const;
  Patch made(std::size_t row, std::size_t column) const;

  mutable std::once_flag once_;
  mutable std::vector<std::atomic<const Patch*>> patches_;  ///< null until it is made
  mutable std::deque<Patch> all_;
  mutable std::mutex making_;
};

}  // namespace slipfront::friction
