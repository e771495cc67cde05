#pragma once

#include <cstddef>
#include <memory>
#include <vector>

namespace slipfront::chain {

/// An absorbing end, where the chain continues as a train at rest. Every disturbance of that train leaves without
/// reflection. The train at the end moves with the mean velocity U = tanh phi of the dislocations next to it. Its psi
/// is that of an outgoing wave with this phi (docs/theory/4_pulse.md). The wave is a fan if it pulls on the train
/// outside, and a shock if it pushes. The deviation v from that train obeys v_t +- v_x = 0. If there is no train
/// outside, u obeys it.
struct AbsorbingEnd {
  double psi0 = 0;                                   ///< psi of the train outside; 0: no train
  std::shared_ptr<const std::vector<double>> shock;  ///< table of psi - psi0 behind shocks, evenly spaced in ln phi
  double a = 1;                                      ///< contact ratio at the end
  double h = 0, dt = 0;                              ///< spacing, step
  double eps = 0;                                    ///< z = u + eps a^2 sin u
  int outward = 1;                                   ///< 1: right end, -1: left
  std::size_t reach = 0;                             ///< number of sites that give the velocity of the train

  struct Step {
    double next;     ///< z / 2 pi of the end at the next level
    double outflow;  ///< energy that leaves on the way there
  };
  /// Computes the table `shock` for a train with psi0 outside.
  static std::shared_ptr<const std::vector<double>> shocks_into(double psi0);

  /// Steps the end site. The arguments point to it at two levels; its neighbours must already have their next level.
  Step step(const double* now, const double* next) const;

 private:
  double psi_at(double phi_outward) const;
  double displacement(double z) const;
  double velocity_of_train(const double* now, const double* next) const;
};

}  // namespace slipfront::chain
