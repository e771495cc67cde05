#pragma once
/// \file
/// The forces on the sites that do not depend on their motion: F, and the static load that holds the initial state.

#include <vector>

#include "plane/direct/sites.hpp"

namespace slipfront::plane {

/// Whether each site lies in the nucleation patch; empty if there is none.
std::vector<char> patch_of(const Problem& problem, const Sites& sites);

class Loads {
 public:
  Loads(const Problem& problem, const Sites& sites);
  /// Sets the static load, which is the opposite of the acceleration of each site at t = 0 without it.
  void hold(const std::vector<double>& acceleration);
  /// Finds the forces at a time, in units of the scenario.
  void find(double time);
  /// The force on each site, stretched; empty: none.
  const std::vector<double>& force() const { return force_; }

 private:
  const Problem& problem_;
  const Sites& sites_;
  std::vector<char> patch_;
  std::vector<double> held_, force_;
  bool is_known_ = false;  ///< whether `force_` is that of the static load, and `released_` of the patch
  bool released_ = false;
};

}  // namespace slipfront::plane
