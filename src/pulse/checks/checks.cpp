#include "pulse/checks/checks.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <string>

#include "foundation/math/interval.hpp"
#include "foundation/text/digits.hpp"

namespace slipfront::pulse {
namespace {

using std::numbers::pi;

/// If streams that cross lose more than this share of the energy of motion, the averages are reported as doubtful.
constexpr double much = 0.05;

}  // namespace

double Checks::largest_slip(const View& v) const {
  double largest = std::fabs(solver_.slip_at(v, 0));
  for (const double slip : snapshots_.back().profile.slip) largest = std::fmax(largest, std::fabs(slip));
  return largest;
}

double Checks::unresolved_slip(const View& v) const {
  constexpr double few = 4;
  const double of_cell = 2 * pi * solver_.charge()[interval(v.faces, 0)];
  return largest_slip(v) < few * of_cell ? of_cell : 0;
}

double Checks::energy_of_motion() const {
  double most = 0;
  for (const output::Snapshot& s : snapshots_)
    most = std::max({most, s.energy.kinetic + s.energy.dissipated, std::fabs(s.energy.supplied)});
  return most;
}

double Checks::contact_doubt() const {
  return solver_.problem().contact ? std::fabs(at_start_.correction) / at_start_.all() : 0;
}

double Checks::energy_doubt() const {
  constexpr double rounding = 1e-12;  // relative rounding error of the states, which each step solves for again
  const StoredEnergy now = stored_energy(solver_);
  return std::fabs(now.correction - at_start_.correction) + 2 * now.unresolved +
         (rounding + contact_doubt()) * std::fmax(now.all(), at_start_.all());
}

output::Findings Checks::findings() const {
  output::Findings found;
  if (snapshots_.empty()) return found;
  check_slip(found);
  check_count(found);
  check_energy(found);
  return found;
}

void Checks::check_slip(output::Findings& found) const {
  if (const std::optional<SlipTwice> slip = slip_.compare(solver_)) {
    constexpr double rounding = 1e-12;
    const View v = solver_.view();
    const double rounded = rounding * 2 * pi * (v.charge_faces.back() - v.charge_faces.front());
    const double doubt = 3 * slip->sampling + slip->of_velocity + rounded + unresolved_slip(v);
    const double beyond = std::fabs(slip->by_place - slip->by_velocity) - doubt;
    const double size = std::max({largest_slip(v), slip_.size(), 2 * pi * contact_doubt()});
    found.violation(beyond / size, "pulse: slip at x = 0 is " + digits(slip->by_place) +
                                       ", the integral of the slip velocity there " + digits(slip->by_velocity) +
                                       "; more cells help");
  }
}

void Checks::check_count(output::Findings& found) const {
  // If streams have piled up, densities can be inaccurate although no dislocation is missing: this is only a
  // warning.
  const double uncounted = conservation_error(solver_);
  if (!(uncounted <= output::Findings::wrong))
    found.sentences.push_back("pulse: the states of the cells hold " + digits(100 * uncounted) +
                              " % more or fewer dislocations than there are; more cells help");
}

void Checks::check_energy(output::Findings& found) const {
  const output::Energy& e = snapshots_.back().energy;
  constexpr double worth = 0.01;  // results count as wrong if more energy is created than moves
  const double motion = energy_of_motion(), created = -e.residual - energy_doubt();
  const bool moved = motion > 0;  // if friction held all cells in every step, the measure is the stored energy
  const double share_created = created / (moved ? motion : at_start_.all());
  found.violation(worth * share_created, "pulse: energy was created, " + digits(100 * share_created) +
                                             (moved ? " % of the energy of motion" : " % of the stored energy") +
                                             "; more cells help");

  const double lost = std::fmax(e.residual - energy_doubt(), 0.0), share = lost > 0 ? lost / (motion + lost) : 0;
  const Cells& cells = solver_.cells();
  if (!std::isnan(cells.crossing_time) && (solver_.problem().contact || share > much))
    found.sentences.push_back("pulse: dislocations overtake each other from t = " + digits(cells.crossing_time) +
                              " at x = " + digits(cells.crossing_position) +
                              " on, where one train per position is not enough; " + digits(100 * share) +
                              " % of the energy of motion is lost there. Compare with a run of the chain");
}

}  // namespace slipfront::pulse
