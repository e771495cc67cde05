// What a pulse run should obey whatever it computes, and the sentences for where it does not.

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include "../digits.hpp"
#include "../findings.hpp"
#include "slipfront/error.hpp"
#include "slipfront/pulse/run.hpp"

namespace slipfront::pulse {
namespace {

/// Share of the energy of motion that is lost where streams cross, above which the averages are doubtful.
constexpr double much = 0.05;

}  // namespace

struct Run::Findings : slipfront::Findings {};

Run::Findings Run::findings() const {
  Findings found;
  if (snapshots_.empty()) return found;
  const output::Snapshot& last = snapshots_.back();
  const Problem& problem = solver_.problem();

  if (problem.left < 0 && problem.right > 0 && passed_.samples > 8) {
    const Solver::View v = solver_.view();
    const double now = averages_of(v, state_at(v, 0), 0).W, slip = solver_.slip_at(v, 0);
    const double rest = (solver_.cells().time - passed_.time) * (now + passed_.velocity) / 2;
    const double by_velocity = passed_.slip + rest;
    constexpr double rounding = 1e-10;
    const double doubt =
        3 * std::fabs(passed_.slip - passed_.coarse_slip) + 3 * std::sqrt(passed_.spread) + passed_.doubt + rounding;
    const double beyond = std::fabs(slip - by_velocity) - doubt;
    found.violation(beyond / std::fmax(std::fabs(slip), passed_.way),
                    "pulse: slip at x = 0 is " + digits(slip) + ", the integral of the slip velocity there " +
                        digits(by_velocity) + "; more pulse.cells help");
  }

  // Densities may be coarse where streams have piled up, while the dislocations themselves are all there.
  const double uncounted = conservation_error(solver_);
  if (!(uncounted <= Findings::wrong))
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

std::vector<std::string> Run::warnings() const { return findings().sentences; }

void Run::refuse_wrong_results() const {
  const Findings found = findings();
  if (found.wrong_results()) throw NumericsError("t = " + digits(solver_.cells().time) + ": " + found.worst);
}

}  // namespace slipfront::pulse
