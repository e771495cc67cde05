#include "output/further_scalars.hpp"

#include <cstddef>
#include <limits>

namespace slipfront::output {
namespace {

constexpr Description declared[] = {
    {"potency", "slip since time 0, integrated along the interface", "b^2 / (2 pi A)", "Eq. 4"},
    {"energy_loading", "energy in the springs that load a chain", "mu b^2 A / (2 pi^2 (1 - nu))", "Eq. 1"},
    {"loading_force", "force F on a site, mean over a chain that springs load everywhere", "mu A^2 / (pi (1 - nu))",
     "Eq. 1"},
    {"loading_stress", "shear stress at the end that a spring pulls", "mu A / pi", "Eq. 1"},
    {"energy_contacts", "energy that contacts supplied as their strength changed", "mu b^2 A / (2 pi^2 (1 - nu))",
     "docs/friction.md"},
    {"pore_pressure_at_origin", "pore pressure around x = 0, over the normal stress", "", "docs/friction.md"},
};

}  // namespace

std::span<const Description> further_scalars() { return declared; }

double further_scalar(const Snapshot& snapshot, std::string_view name) {
  const auto found = snapshot.further.find(name);
  return found == snapshot.further.end() ? std::numeric_limits<double>::quiet_NaN() : found->second;
}

void add_further_scalars(Snapshot& snapshot, const Schedule& schedule) {
  snapshot.further.try_emplace("energy_loading", 0);  // without springs
  snapshot.further.try_emplace("energy_contacts", 0);
  snapshot.further.try_emplace("pore_pressure_at_origin", 0);  // without pores
  double& potency = snapshot.further["potency"] = 0;
  const std::vector<double>&slip = snapshot.profile.slip, &x = schedule.x_edges;
  for (std::size_t i = 0; i < slip.size(); ++i) potency += slip[i] * (x[i + 1] - x[i]);
}

}  // namespace slipfront::output
