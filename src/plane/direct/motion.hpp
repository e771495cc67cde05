#pragma once
/// \file
/// The motion of all sites, and its steps.

#include <functional>
#include <vector>

#include "plane/direct/rows.hpp"
#include "plane/direct/sites.hpp"

namespace slipfront::plane {

/// Displacements of all sites at two times, one step apart, stretched. Steps are equal throughout a run, because a
/// change of the step takes energy from short waves.
struct Motion {
  long steps = 0;                       ///< `u` is at the time steps * dt
  std::vector<double> u, old;           ///< now, and one step before
  double dissipated = 0, supplied = 0;  ///< stretched, from t = 0 to the middle between `old` and `u`
};

/// The motion at a time of observation, which is at most half a step from that of the step.
struct Look {
  double time = 0;  ///< in units of the scenario
  std::vector<double> u, velocity;
  double kinetic = 0, elastic = 0, dissipated = 0, supplied = 0;  ///< stretched, at the time of the step
};

class Stepper {
 public:
  Stepper(const Problem& problem, const Sites& sites, int threads);

  /// The motion at t = 0, of lines at rest.
  Motion start(std::vector<double> u);
  /// Steps until the time is at most half a step ahead, or until `interrupted` returns true. Returns whether it is.
  bool advance(Motion& motion, double time, const std::function<bool()>& interrupted);
  /// Fills `look`. \throws NumericsError for a displacement that is not finite.
  void look_at(const Motion& motion, double time, Look& look);
  double time_of(const Motion& motion) const { return static_cast<double>(motion.steps) * dt_ / sites_.scale; }

 private:
  /// Finds u one step later in `next`, which has u one step before on entry. Returns the work of this step.
  struct Work {
    double dissipated, supplied;
  };
  Work step(double time, const std::vector<double>& u, std::vector<double>& next);
  void step_rows(const std::vector<double>& u, std::size_t first, std::size_t last, std::vector<double>& next);
  double rub(std::size_t row, const double* before, double* after) const;
  void find_force(double time);
  void fill_ghosts(std::vector<double>& f) const;
  void fill_ends(double* row) const;
  std::vector<double> accelerations(const std::vector<double>& u) const;
  void find_velocity(const std::vector<double>& u, const std::vector<double>& before, const std::vector<double>& after,
                     std::vector<double>& velocity) const;
  void find_energy(const std::vector<double>& u, Look& look) const;
  /// Calls each(at, i) for the sites of all rows, on several threads; `at` is the index of a site.
  template <class Each>
  void for_each_site(const Each& each) const;

  const Problem& problem_;
  const Sites& sites_;
  int threads_;
  RowShape shape_;
  double dt_;                  ///< stretched
  std::vector<double> force_;  ///< F / scale; empty: none
  std::vector<double> work_of_row_, supply_of_row_;
  std::vector<double> next_;  ///< one step after a look
};

}  // namespace slipfront::plane
