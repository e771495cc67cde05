#pragma once

#include <atomic>
#include <deque>
#include <mutex>
#include <vector>

#include "friction/train_means/chebyshev.hpp"
#include "slipfront/friction/law.hpp"

namespace slipfront::friction {

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
