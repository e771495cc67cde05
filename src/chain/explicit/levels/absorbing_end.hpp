#pragma once

#include <cstddef>
#include <memory>
#include <vector>

namespace slipfront::chain {

/// An end where the chain continues as a train at rest. All that departs from that train leaves and does not come back.
/// The train at the end moves with the mean velocity U = tanh phi of the dislocations next to it. Its psi is that of a
/// wave which leaves at this phi: a fan where it pulls on the train outside, a shock where it presses on it
/// (docs/theory.md 4). The departure from that train, v, obeys v_t +- v_x = 0. If there is no train outside, u does.
struct AbsorbingEnd {
  double psi0 = 0;                                   ///< of the train outside; 0: none
  std::shared_ptr<const std::vector<double>> shock;  ///< psi - psi0 behind shocks, of steps in ln phi
  double a = 1;                                      ///< contact ratio at the end
  double h = 0, dt = 0;                              ///< spacing, step
  double eps = 0;                                    ///< z = u + eps a^2 sin u
  int outward = 1;                                   ///< 1: right end, -1: left
  std::size_t reach = 0;                             ///< sites next to it from which the velocity of the train is found

  struct Step {
    double next;     ///< z / 2 pi of the end at the next level
    double outflow;  ///< energy that leaves on the way there
  };
  /// For a train with psi0 outside.
  static std::shared_ptr<const std::vector<double>> shocks_into(double psi0);

  /// Pointers to the end site at two levels; its neighbours have their next level already.
  Step step(const double* now, const double* next) const;

 private:
  double psi_at(double phi_outward) const;
  double displacement(double z) const;
  double velocity_of_train(const double* now, const double* next) const;
};

}  // namespace slipfront::chain
