#include "lattice/chain/run_checks.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <utility>

#include "lattice/chain/model/initial_train.hpp"
#include "math/constants.hpp"
#include "math/digits.hpp"

namespace slipfront::chain {
namespace {

using output::Findings;

/// Whether the chain contains only the dislocations of the start. A force can create others anywhere. At a free end
/// they can enter, and around a ring they return.
bool only_starting_dislocations(const ScaledProblem& s) {
  const bool fixed = !s.boundary.periodic && s.boundary.left == End::fixed && s.boundary.right == End::fixed;
  return !s.forcing && !s.loading.acts() && fixed;
}

/// Whether the initial stress is a step at x = 0 between two uniform sides.
bool is_step(const ScaledProblem& s) {
  return !s.contact && s.stress(s.left) == s.stress(s.left / 1e6) && s.stress(s.right) == s.stress(s.right / 1e6) &&
         s.stress(s.left / 2) == s.stress(s.left) && s.stress(s.right / 2) == s.stress(s.right) && s.left < 0 &&
         s.right > 0;
}

}  // namespace

RunChecks::RunChecks(const RunObserver& observer, const std::vector<output::Snapshot>& snapshots)
    : observer_(observer), scaled_(observer.scaled()), chain_(observer.chain()), snapshots_(snapshots) {}

void RunChecks::check_energy(const Balance& balance, Findings& found) const {
  std::string sentence = "chain: energy and work differ by " + digits(balance.energy_drift) + " of the energy";
  if (scaled_.model == Model::sine_gordon) {
    const double sites = 2 / balance.steepest;  // the slope of a dislocation is 2 over its width
    if (sites < least_sites_per_width)
      sentence += ". The narrowest dislocation, made so by its speed or by others, has only " + digits(sites, 2) +
                  " sites to its width; " + digits(least_sites_per_width) + " are needed";
    // The error is of fourth order in the spacing.
    const double finer = 0.9 * scaled_.spacing * std::pow(Findings::worth_a_warning / balance.energy_drift, 0.25);
    sentence += ". Try a spacing of " + digits(finer, 2);
  }
  found.violation(balance.energy_drift, sentence);
}

void RunChecks::check_fronts(Findings& found) const {
  const output::Fronts& last = snapshots_.back().fronts;
  const Grid& grid = chain_.problem().grid;  // its last site may be outside the domain by less than a spacing
  const double end = std::fmax(scaled_.right, grid.x(grid.sites - 1) / scaled_.scale);
  for (const auto& [name, x] :
       {std::pair{"leading", last.leading}, {"observed", last.leading_observed}, {"observed", last.trailing_observed}})
    if (x < scaled_.left || x > end)
      found.violation(1, std::string("chain: the ") + name + " front at " + digits(x) + " is outside the domain");
}

/// No front is faster than c.
void RunChecks::check_speed_of_fronts(Findings& found) const {
  if (!only_starting_dislocations(scaled_)) return;
  const double site = chain_.problem().grid.spacing / scaled_.scale;
  for (std::size_t i = 1; i < snapshots_.size(); ++i) {
    const output::Snapshot &before = snapshots_[i - 1], &now = snapshots_[i];
    const double gone = std::fabs(now.fronts.leading - before.fronts.leading), time = now.time - before.time;
    if (gone > time + site)
      found.violation((gone - site) / time - 1, "chain: the leading front is faster than c, " + digits(gone / time) +
                                                    " c between t = " + digits(before.time) + " and " +
                                                    digits(now.time));
  }
}

/// If the stress is a step between two uniform trains, motion begins at x = 0 and spreads no faster than c. Other
/// profiles move everywhere at once.
void RunChecks::check_observed_fronts(Findings& found) const {
  if (!only_starting_dislocations(scaled_) || !is_step(scaled_)) return;
  const output::Snapshot& last = snapshots_.back();
  const output::Schedule& schedule = observer_.schedule();
  const double cell = schedule.x_edges.size() > 1 ? schedule.x_edges[1] - schedule.x_edges[0] : 0;
  const double allowed = last.time + std::fmax(observer_.smooth_window() / 2, cell) + cell;
  for (const double x : {last.fronts.leading_observed, last.fronts.trailing_observed})
    if (std::fabs(x) > allowed)
      found.sentences.push_back("chain: an observed front at x = " + digits(x) +
                                " is farther from x = 0 than c carries it in t = " + digits(last.time) +
                                ": errors of the grid there exceed the threshold " + digits(schedule.threshold) +
                                " of the peak slip velocity");
}

/// Warns if the forces at the start are too weak for the barrier of the grid, which holds slow dislocations. At 20
/// times the barrier, dislocations are some 0.1 % too slow.
void RunChecks::check_barrier(Findings& found) const {
  constexpr double enough = 20;
  const ScaledProblem& s = scaled_;
  const double pushed = observer_.driving_force_at_start(), force = pushed / s.scale;
  const double spacing = chain_.problem().grid.spacing;
  if (s.model != Model::sine_gordon || s.loading.acts() || !s.substrate || !(pushed > 1e-9) ||
      force >= enough * barrier_force(spacing))
    return;
  found.sentences.push_back("chain: the grid holds slow dislocations. The largest force on one, " + digits(pushed, 2) +
                            ", is " + digits(force / barrier_force(spacing), 2) +
                            " times the barrier of the grid at spacing " + digits(spacing, 3) + "; " + digits(enough) +
                            " are needed. Try a spacing of " +
                            digits(spacing_with_barrier_below(force / enough, spacing)));
}

/// Compares the slip at x = 0, u minus u at t = 0, with the integral of the velocity there. The run sampled this
/// velocity independently.
void RunChecks::check_slip(Findings& found) const {
  if (!observer_.sees_origin()) return;
  const RunObserver::OriginSlip slip = observer_.origin_slip();
  if (slip.samples <= 7) return;
  const double quarter = turn / 4;  // the slip of a quarter of a dislocation
  const double excess = std::fabs(slip.by_displacement - slip.by_velocity) - (3 * slip.error + quarter);
  found.violation(excess / std::fmax(std::fabs(slip.by_displacement), turn),
                  "chain: slip at x = 0 is " + digits(slip.by_displacement / scaled_.scale) +
                      ", but the integral of the slip velocity there is " + digits(slip.by_velocity / scaled_.scale));
}

/// Makes two checks if nothing creates antidislocations. The number of dislocations, counted where u passes pi, must
/// agree with the charge of the ends. And |W| <= k must hold.
void RunChecks::check_one_sign(const Balance& balance, Findings& found) const {
  const ScaledProblem& s = scaled_;
  const bool closed = s.boundary.periodic || (s.boundary.left == End::fixed && s.boundary.right == End::fixed);
  if (!closed || s.forcing || s.loading.acts()) return;
  const auto counted = static_cast<double>(balance.dislocations);
  const double charge = std::fabs(observer_.charge_at_start() + balance.charge_error);
  const double more = std::fabs(counted - charge) - 1.5;  // a fixed end may hold a part of one
  found.violation(more / std::fmax(charge, 100),
                  "chain: " + digits(counted) + " dislocations, but the ends require " + digits(charge));
  const output::Profile& last = snapshots_.back().profile;
  double k_most = 0, excess = 0;
  for (std::size_t i = 0; i < last.k.size(); ++i) {
    k_most = std::fmax(k_most, std::fabs(last.k[i]));
    excess = std::fmax(excess, std::fabs(last.W[i]) - std::fabs(last.k[i]));
  }
  // Waves have a mean velocity of either sign even without dislocations. It is as large as that of a fraction of a
  // dislocation in the window.
  const double one = turn / (s.scale * observer_.smooth_window());
  found.violation((excess - 0.1 * one) / std::fmax(k_most, one),
                  "chain: the slip velocity is larger than the stress by " + digits(excess));
}

/// Warns if so few dislocations passed x = 0 that the slip there, a whole number of them, is inaccurate. A chain
/// without a substrate has no dislocations, and its slip is not a whole number.
void RunChecks::check_dislocations(Findings& found) const {
  const double last_slip = snapshots_.back().slip_at_origin, scale = scaled_.scale;
  if (!observer_.sees_origin() || last_slip == 0 || !chain_.problem().substrate) return;
  const double step = turn / scale, slip = std::fabs(last_slip);
  if (!(step / 4 > 0.01 * slip && slip > 1e-3 * step)) return;
  found.sentences.push_back("chain: " + digits(static_cast<double>(observer_.dislocations_at_start())) +
                            " dislocations at scale " + digits(scale) + ", of which " + digits(slip / step) +
                            " passed x = 0; each adds a slip of " + digits(step) + ". For an error of 1 %, try scale " +
                            digits(std::pow(10, std::ceil(2 * std::log10(25 * turn / slip)) / 2)));
}

Findings RunChecks::findings() const {
  Findings found;
  if (snapshots_.empty()) return found;
  const Balance balance = observer_.balance();
  check_energy(balance, found);
  check_slip(found);
  check_one_sign(balance, found);
  check_fronts(found);
  check_speed_of_fronts(found);
  check_observed_fronts(found);
  check_barrier(found);
  check_dislocations(found);
  return found;
}

}  // namespace slipfront::chain
