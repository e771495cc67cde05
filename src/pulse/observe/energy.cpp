#include "pulse/observe/energy.hpp"

#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

#include "foundation/math/constants.hpp"
#include "slipfront/modulation/per_dislocation.hpp"

namespace slipfront::pulse {
namespace {

using output::Energy;
using std::numbers::pi;

/// Sums values per dislocation, given at the cell centres, over all dislocations. The sum is of fourth order in the
/// coordinate of the cells where the values are smooth, and of second order next to a jump or a free edge.
struct SumOverCells {
  const std::vector<double>& charge;
  double corrections = 0;  ///< total of the corrections in all sums
  double rough = 0;        ///< part of the last sum that comes from cells where the values are not smooth

  double operator()(const std::vector<double>& f) {
    double sum = 0;
    rough = 0;
    for (std::size_t i = 0; i < f.size(); ++i) {
      if (charge[i] == 0) continue;
      sum += charge[i] * f[i];
      if (!is_smooth(f, i)) {
        rough += charge[i] * f[i];
        continue;
      }
      corrections += correction(f, i);
      sum += correction(f, i);
    }
    return sum;
  }

 private:
  bool is_smooth(const std::vector<double>& f, std::size_t i) const {
    if (i == 0 || i + 1 == f.size() || charge[i - 1] == 0 || charge[i + 1] == 0) return false;
    const double before = f[i] - f[i - 1], behind = f[i + 1] - f[i];
    constexpr double smooth = 0.7;
    return std::fabs(behind - before) < smooth * (std::fabs(before) + std::fabs(behind));
  }
  double correction(const std::vector<double>& f, std::size_t i) const {
    return (f[i + 1] - 2 * f[i] + f[i - 1]) / 24 * charge[i] +
           (f[i + 1] - f[i - 1]) * (charge[i + 1] - charge[i - 1]) / 48;
  }
};

StoredEnergy stored_energy(const Solver& solver, const View& v) {
  const std::size_t n = v.states.size();
  std::vector<double> isolated(n), interaction(n), kinetic(n);
  for (std::size_t i = 0; i < n; ++i) {
    if (solver.charge()[i] == 0) continue;
    const double contact = v.contact ? v.contact(v.centres[i]) : 1;
    isolated[i] = 8 * contact;
    kinetic[i] = contact * modulation::kinetic_energy(v.states[i]);
    if (v.states[i].empty()) continue;  // dislocations too far apart to interact
    const double spacing = modulation::lagrangian_state(v.states[i]).spacing;
    interaction[i] = contact * modulation::interaction_energy(modulation::state_of({spacing, 0}, v.states[i].psi).psi);
  }
  SumOverCells sum{solver.charge()};
  StoredEnergy e{};
  e.isolated = sum(isolated);
  e.interaction = sum(interaction);
  e.kinetic = std::fmax(sum(kinetic), 0.0);
  e.correction = sum.corrections;
  e.unresolved = sum.rough;
  return e;
}

}  // namespace

Energy energy_of(const Solver& solver, const View& v) {
  const StoredEnergy stored = stored_energy(solver, v);
  return {.elastic = stored.elastic(),
          .kinetic = stored.kinetic,
          .dissipated = solver.dissipated(),
          .supplied = solver.supplied(),
          .through_ends = solver.through_ends(),
          .shocks = none,
          .residual = none,
          .phonons = none};
}

StoredEnergy stored_energy(const Solver& solver) { return stored_energy(solver, solver.view(false)); }

double conservation_error(const Solver& solver) {
  const View v = solver.view();
  double counted = 0, known = 0;
  for (std::size_t i = 0; i < v.states.size(); ++i) {
    known += solver.charge()[i];
    if (v.states[i].empty()) continue;
    const double middle = averages_of(v, v.states[i], v.centres[i]).k / (2 * pi);
    counted += (v.face_density[i] + 4 * middle + v.face_density[i + 1]) / 6 * (v.faces[i + 1] - v.faces[i]);
  }
  return std::fabs(counted - known) / known;
}

}  // namespace slipfront::pulse
