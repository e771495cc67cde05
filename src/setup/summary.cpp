#include "slipfront/setup/summary.hpp"

#include "slipfront/pulse/observe.hpp"
#include "slipfront/setup/pulse.hpp"

namespace slipfront::setup {

std::vector<SummaryValue> pulse_summary(const scenario::Scenario& scenario, const pulse::Run& run, double wall) {
  const pulse::Snapshot& s = run.snapshots().back();
  const modulation::Friction& friction = scenario.friction;
  return {
      {"closure", closure_name(friction.closure), "how friction is averaged"},
      {"friction_coefficient", friction.coefficient, "C"},
      {"damping_number", friction.coefficient * s.time, "Gamma = C t"},
      {"time", s.time, "in b / (c A)"},
      {"slip_velocity_at_origin", s.slip_velocity_at_origin, "W at x = 0, in c A / pi"},
      {"stress_at_origin", s.stress_at_origin, "Sigma at x = 0, in mu A / pi"},
      {"slip_at_origin", s.slip_at_origin, "u at x = 0 since t = 0, in b / (2 pi)"},
      {"peak_slip_velocity", s.peak_slip_velocity, "largest W, in c A / pi"},
      {"peak_position", s.peak_position, "its x, in b / A"},
      {"trailing_front", s.fronts.trailing, "x of the fast front (its characteristic), in b / A"},
      {"leading_front", s.fronts.leading, "x of the slow front, in b / A"},
      {"trailing_front_observed", s.fronts.trailing_observed, "as an observer with a threshold sees it"},
      {"leading_front_observed", s.fronts.leading_observed, "as an observer with a threshold sees it"},
      {"energy_elastic", s.energy.elastic, "of the state at rest"},
      {"energy_kinetic", s.energy.kinetic, "the rest of H"},
      {"energy_dissipated", s.energy.dissipated, "by friction since t = 0"},
      {"energy_supplied", s.energy.supplied, "by F since t = 0"},
      {"conservation_error", pulse::conservation_error(run.solver(), run.schedule().x_edges, s.profile),
       "of the dislocation number, relative"},
      {"cells", static_cast<long>(run.solver().size()), ""},
      {"steps", run.solver().cells().steps, ""},
      {"solve_seconds", run.stepping_seconds(), "of the time steps alone"},
      {"wall_seconds", wall, "of the whole command"},
  };
}

std::vector<SummaryValue> chain_summary(const chain::Run& run, const chain::Run::Balance& balance,
                                        const ChainWork& work) {
  const pulse::Snapshot& s = run.snapshots().back();
  const chain::Grid& grid = run.chain().problem().grid;
  const double updates = static_cast<double>(grid.sites) * static_cast<double>(work.steps);
  return {
      {"time", s.time, "in b / (c A)"},
      {"scale", run.scale(), "x and t are stretched by it, friction divided"},
      {"slip_at_origin", s.slip_at_origin, "u at x = 0 since t = 0 over the scale, in b / (2 pi)"},
      {"slip_velocity_at_origin", s.slip_velocity_at_origin, "weighted mean of u_t, in c A / pi"},
      {"stress_at_origin", s.stress_at_origin, "weighted mean of -u_x, in mu A / pi"},
      {"window", run.window(), "of the slip at x = 0, in b / A"},
      {"smooth_window", run.smooth_window(), "of velocities and stresses, in b / A"},
      {"peak_slip_velocity", s.peak_slip_velocity, "largest of the profile, in c A / pi"},
      {"peak_position", s.peak_position, "its x, in b / A"},
      {"leading_front", s.fronts.leading, "x of the last dislocation, in b / A"},
      {"trailing_front_observed", s.fronts.trailing_observed, "as an observer with a threshold sees it"},
      {"leading_front_observed", s.fronts.leading_observed, "as an observer with a threshold sees it"},
      {"dislocations", balance.dislocations, "at the end"},
      {"energy_drift", balance.energy_drift, "energy and work since t = 0, relative"},
      {"charge_error", balance.charge_error, "change of the charge"},
      {"sites", static_cast<long>(grid.sites), ""},
      {"spacing", grid.spacing, "of the sites, on the chain"},
      {"steps", run.chain().level(), ""},
      {"ranks", static_cast<long>(work.ranks), ""},
      {"threads", static_cast<long>(work.threads), "of each rank"},
      {"site_updates_per_second", work.stepping > 0 ? updates / work.stepping : 0, "output included"},
      {"wall_seconds", work.wall, "of the whole command"},
  };
}

}  // namespace slipfront::setup
