#include "averages/pulse/checks/checks.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <string>

#include "math/constants.hpp"
#include "math/digits.hpp"

namespace slipfront::pulse {
namespace {

/// Estimates the error of the slip velocity W at x. It is the distance of W from the straight line between the cell
/// centre and the face on the same side as x, plus 1 % of the change of W between the two. Such an error arises if a
/// pulse is narrower than a cell, because the cells then do not resolve it.
double unresolved_at(const View& v, double x, double W) {
  const auto right = std::upper_bound(v.faces.begin() + 1, v.faces.end() - 1, x);
  const auto cell = static_cast<std::size_t>(right - v.faces.begin() - 1);
  if (v.states[cell].empty()) return 0;
  constexpr double interpolated = 0.01;
  const std::size_t face = x < v.centres[cell] ? cell : cell + 1;
  const double at_face = averages_of(v, v.face_states[face], v.faces[face]).W;
  const double at_centre = averages_of(v, v.states[cell], v.centres[cell]).W;
  const double share = (x - v.centres[cell]) / (v.faces[face] - v.centres[cell]);
  return std::fabs(W - std::lerp(at_centre, at_face, share)) + interpolated * std::fabs(at_face - at_centre);
}

}  // namespace

double SlipTwice::error() const {
  const double apart = std::fabs(by_place - by_velocity);
  return std::fmax(apart - sampling, std::fmin(apart, of_velocity));
}

void SlipRecord::sample(const Solver& solver) {
  const View v = solver.view(false);
  const double velocity = averages_of(v, state_at(v, 0), 0).W;
  add(solver.cells().time, velocity, unresolved_at(v, 0, velocity));
}

void SlipRecord::add(double time, double velocity, double doubt) {
  const double elapsed = time - integral_.time;
  size_ += elapsed * (std::fabs(velocity) + std::fabs(integral_.velocity)) / 2;
  doubt_ += elapsed * doubt;
  integral_.add(time, velocity);
}

std::optional<SlipTwice> SlipRecord::compare(const Solver& solver) const {
  if (!can_compare(solver.problem())) return std::nullopt;
  const View v = solver.view();
  return compare(solver.cells().time, solver.slip_at(v, 0), averages_of(v, state_at(v, 0), 0).W);
}

bool SlipRecord::can_compare(const Problem& problem) const {
  return problem.left < 0 && problem.right > 0 && integral_.samples > 8;
}

SlipTwice SlipRecord::compare(double time, double slip, double velocity) const {
  return {slip, integral_.up_to(time, velocity), integral_.error(), doubt_};
}

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
