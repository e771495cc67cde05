#pragma once

#include <atomic>
#include <deque>
#include <mutex>
#include <vector>

#include "friction/chebyshev_patch.hpp"
#include "slipfront/friction/law.hpp"

namespace slipfront::friction {

/// The mean over slip of a law without memory, as polynomials in the logarithms of the fastest slip velocity and of
/// s = tanh psi. A patch is made when a train first lies in it, from 64 means, and is kept only if it is as good as
/// those between its nodes too: where the law has a kink, beyond the patches, and with closure "paper" each mean is
/// found by itself.
class MeanTable {
 public:
  /// The law outlives it.
  explicit MeanTable(const Law& law) : law_(law) {}
  /// Means, and unless null what they change by with ln(fastest). May be called by threads.
  void look_up(const Trains& trains, Closure closure, double* mean, double* slope) const;

 private:
  struct Patch {
    ChebyshevPatch polynomial;
    bool good;
  };
  /// Null where polynomials do not do.
  const ChebyshevPatch* good_patch(std::size_t row, std::size_t column) const;
  Patch made(std::size_t row, std::size_t column) const;

  const Law& law_;
  mutable std::once_flag laid_;
  mutable std::vector<std::atomic<const Patch*>> patches_;  ///< null until it is made
  mutable std::deque<Patch> all_;
  mutable std::mutex making_;
};

}  // namespace slipfront::friction
