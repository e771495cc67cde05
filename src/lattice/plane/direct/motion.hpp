#pragma once
/// \file
/// The motion of all sites, and its steps.

#include <functional>
#include <vector>

#include "lattice/plane/direct/rows.hpp"
#include "lattice/plane/direct/sites.hpp"
#include "system/ranks.hpp"

namespace slipfront::plane {

/// Energies that a row gained or lost, per area of a site, stretched.
struct RowWork {
  double dissipated = 0, supplied = 0, radiated = 0;
};

/// Displacements of the sites of a rank at two times, one step apart, stretched. Steps are equal throughout a run,
/// because a change of the step takes energy from short waves.
struct Motion {
  long steps = 0;              ///< `u` is at the time steps * dt
  std::vector<double> u, old;  ///< now, and one step before
  std::vector<double> v_old;   ///< accelerations without friction one step before; empty unless friction is viscous
  std::vector<RowWork> work;   ///< each row has its own, from t = 0 to the middle between `old` and `u`
};

/// The motion at a time of observation, which is at most half a step from that of the step.
struct Sums {
  double time = 0;  ///< in units of the scenario
  std::vector<double> u, velocity;
  /// Stretched energies of the whole plane at the time of the step.
  double kinetic = 0, elastic = 0, dissipated = 0, supplied = 0, radiated = 0;
};

/// The sites of all ranks step together: all ranks make each of the calls of a stepper. Sums are sums over rows, added
/// up in order, so that no bit depends on the number of ranks.
class Stepper {
 public:
  Stepper(const Problem& problem, const Sites& sites, int threads, const Ranks& ranks = Ranks::single());

  /// The motion at t = 0, of lines at rest.
  Motion start(std::vector<double> u);
  /// Steps until the time is at most half a step ahead, or until `interrupted` returns true. Returns whether it is.
  bool advance(Motion& motion, double time, const std::function<bool()>& interrupted);
  /// Fills `look`. \throws NumericsError for a displacement that is not finite.
  void look_at(const Motion& motion, double time, Sums& look);
  /// Fills the ghosts of an array from the sites inside the domain and from the other ranks.
  void fill_ghosts(std::vector<double>& f) const;
  /// u_tt of each site at rest without friction and forces.
  std::vector<double> accelerations_at_rest(std::vector<double> u) const;
  SiteFriction& friction() { return friction_; }
  const SiteFriction& friction() const { return friction_; }
  double time_of(const Motion& motion) const { return static_cast<double>(motion.steps) * dt_ / sites_.scale; }

 private:
  /// `next` has u one step before on entry, and u one step later on return; `v_old` likewise the accelerations without
  /// friction one step before and those of the step.
  struct Stepped {
    std::vector<double>&next, &v_old;
  };
  class Window;
  /// Takes a step, and finds its work.
  void step(const Motion& motion, Stepped to);
  void step_rows(const Motion& motion, std::size_t first, std::size_t last, Stepped to);
  void step_part(const Motion& motion, const RowPart& part, Window& window, Stepped to);
  void prefetch(const Motion& motion, const RowPart& part, const Stepped& to) const;
  /// Whether friction, edges or forces do work in a step.
  bool acts_on_steps() const;
  void accelerate_row(const std::vector<double>& u, std::ptrdiff_t row, const Acceleration& result) const;
  template <class Each>
  void for_each_acceleration(const std::vector<double>& u, const Each& each) const;
  void rub(const Motion& motion, const RowPart& part, const Rates& rates, const double* before, double* after);
  void fill_ends(double* row) const;
  std::ptrdiff_t inside(std::ptrdiff_t row) const;
  std::vector<double> rates_of_change(const std::vector<double>& v, std::size_t row, const Acceleration& now) const;
  std::vector<double> accelerations(const std::vector<double>& u) const;
  void find_velocity(const std::vector<double>& u, const std::vector<double>& before, const std::vector<double>& after,
                     std::vector<double>& velocity) const;
  void find_energy(const std::vector<double>& u, Sums& look) const;
  void find_work(const Motion& motion, Sums& look) const;
  double integral(const std::vector<double>& of_row) const;
  /// Calls each(at, i) for the sites of all rows, on several threads; `at` is the index of a site.
  template <class Each>
  void for_each_site(const Each& each) const;

  const Problem& problem_;
  const Sites& sites_;
  int threads_;
  const Ranks& ranks_;
  RowShape shape_;
  double dt_;  ///< stretched
  Loads loads_;
  SiteFriction friction_;
  std::vector<RowWork> work_of_row_;   ///< in the last step
  std::vector<double> next_, v_next_;  ///< one step after a look
  bool acts_on_steps_ = false;         ///< acts_on_steps() in the last step
};

}  // namespace slipfront::plane
