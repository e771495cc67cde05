// What a pulse run should obey whatever it computes, and the sentences for where it does not.

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <string>

#include "foundation/text/digits.hpp"
#include "pulse/grid/interval.hpp"
#include "slipfront/pulse/run.hpp"

namespace slipfront::pulse {
namespace {

using std::numbers::pi;

/// Share of the energy of motion that is lost where streams cross, above which the averages are doubtful.
constexpr double much = 0.05;

}  // namespace

double Run::SlipTwice::error() const {
  const double apart = std::fabs(by_place - by_velocity);
  return std::fmax(apart - sampling, std::fmin(apart, of_velocity));
}

std::optional<Run::SlipTwice> Run::slip_twice() const {
  const Problem& problem = solver_.problem();
  if (!(problem.left < 0 && problem.right > 0 && slip_.samples > 8)) return std::nullopt;
  const Solver::View v = solver_.view();
  const double now = averages_of(v, state_at(v, 0), 0).W;
  return SlipTwice{solver_.slip_at(v, 0), slip_.up_to(solver_.cells().time, now), slip_.error(), slip_doubt_};
}

double Run::largest_slip(const Solver::View& v) const {
  double largest = std::fabs(solver_.slip_at(v, 0));
  for (const double slip : snapshots_.back().profile.slip) largest = std::fmax(largest, std::fabs(slip));
  return largest;
}

double Run::unresolved_slip(const Solver::View& v) const {
  constexpr double few = 4;
  const double of_cell = 2 * pi * solver_.charge()[interval(v.faces, 0)];
  return largest_slip(v) < few * of_cell ? of_cell : 0;
}

double Run::energy_of_motion() const {
  double most = 0;
  for (const output::Snapshot& s : snapshots_)
    most = std::max({most, s.energy.kinetic + s.energy.dissipated, std::fabs(s.energy.supplied)});
  return most;
}

double Run::contact_doubt() const {
  return solver_.problem().contact ? std::fabs(first_energy_.correction) / first_energy_.all() : 0;
}

double Run::energy_doubt() const {
  constexpr double rounding = 1e-12;  // of the states, which each step solves for anew
  const StoredEnergy now = stored_energy(solver_);
  return std::fabs(now.correction - first_energy_.correction) + 2 * now.unresolved +
         (rounding + contact_doubt()) * std::fmax(now.all(), first_energy_.all());
}

output::Findings Run::findings() const {
  output::Findings found;
  if (snapshots_.empty()) return found;
  const output::Snapshot& last = snapshots_.back();
  const Problem& problem = solver_.problem();

  if (const std::optional<SlipTwice> slip = slip_twice()) {
    constexpr double rounding = 1e-12;
    const Solver::View v = solver_.view();
    const double rounded = rounding * 2 * pi * (v.charge_faces.back() - v.charge_faces.front());
    const double doubt = 3 * slip->sampling + slip->of_velocity + rounded + unresolved_slip(v);
    const double beyond = std::fabs(slip->by_place - slip->by_velocity) - doubt;
    const double size = std::max({largest_slip(v), slip_size_, 2 * pi * contact_doubt()});
    found.violation(beyond / size, "pulse: slip at x = 0 is " + digits(slip->by_place) +
                                       ", the integral of the slip velocity there " + digits(slip->by_velocity) +
                                       "; more pulse.cells help");
  }

  // Densities may be coarse where streams have piled up, while the dislocations themselves are all there.
  const double uncounted = conservation_error(solver_);
  if (!(uncounted <= output::Findings::wrong))
    found.sentences.push_back("pulse: the states of the cells hold " + digits(100 * uncounted) +
                              " % more or fewer dislocations than there are; more pulse.cells help");

  const output::Energy& e = last.energy;
  constexpr double worth = 0.01;  // results are wrong where as much appeared as moves
  const double motion = energy_of_motion(), created = -e.shocks - energy_doubt();
  const bool moved = motion > 0;  // friction may hold all cells in every step: then all energy is the measure
  const double share_created = created / (moved ? motion : first_energy_.all());
  found.violation(worth * share_created, "pulse: energy came from nothing, " + digits(100 * share_created) +
                                             (moved ? " % of that of the motion" : " % of that which is stored") +
                                             "; more pulse.cells help");

  const double lost = std::fmax(e.shocks - energy_doubt(), 0.0), share = lost > 0 ? lost / (motion + lost) : 0;
  const Cells& cells = solver_.cells();
  if (!std::isnan(cells.crossing_time) && (problem.contact || share > much))
    found.sentences.push_back("pulse: dislocations overtake each other from t = " + digits(cells.crossing_time) +
                              " at x = " + digits(cells.crossing_position) +
                              " on, where one train at a place is not enough; " + digits(100 * share) +
                              " % of the energy of motion is lost there. Compare with slipfront chain");
  return found;
}

std::vector<std::string> Run::warnings() const {
  return final_findings_ ? final_findings_->sentences : findings().sentences;
}

}  // namespace slipfront::pulse
