// What a pulse run should obey whatever it computes, and the sentences for where it does not.

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>

#include "../digits.hpp"
#include "slipfront/pulse/run.hpp"

namespace slipfront::pulse {
namespace {

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

output::Findings Run::findings() const {
  output::Findings found;
  if (snapshots_.empty()) return found;
  const output::Snapshot& last = snapshots_.back();
  const Problem& problem = solver_.problem();

  if (const std::optional<SlipTwice> slip = slip_twice()) {
    constexpr double rounding = 1e-10;
    const double doubt = 3 * slip->sampling + slip->of_velocity + rounding;
    const double beyond = std::fabs(slip->by_place - slip->by_velocity) - doubt;
    found.violation(beyond / std::fmax(std::fabs(slip->by_place), slip_size_),
                    "pulse: slip at x = 0 is " + digits(slip->by_place) + ", the integral of the slip velocity there " +
                        digits(slip->by_velocity) + "; more pulse.cells help");
  }

  // Densities may be coarse where streams have piled up, while the dislocations themselves are all there.
  const double uncounted = conservation_error(solver_);
  if (!(uncounted <= output::Findings::wrong))
    found.sentences.push_back("pulse: the states of the cells hold " + digits(100 * uncounted) +
                              " % more or fewer dislocations than there are; more pulse.cells help");

  const output::Energy& e = last.energy;
  const double all = std::max({first_energy_, e.elastic + e.kinetic, std::fabs(e.supplied), e.dissipated});
  found.violation(-e.shocks / all, "pulse: " + digits(-100 * e.shocks / all) +
                                       " % of the energy came from nothing; more pulse.cells help");

  const double motion = e.kinetic + e.dissipated + std::fabs(e.shocks), share = e.shocks / motion;
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
