// Conditions that every chain run should meet. A run that misses one warns, or ends with a NumericsError.

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <utility>

#include "chain/model/barrier.hpp"
#include "foundation/text/digits.hpp"
#include "slipfront/chain/run.hpp"
#include "slipfront/error.hpp"
#include "slipfront/train/train.hpp"

namespace slipfront::chain {
namespace {

using output::Findings;
constexpr double turn = 2 * std::numbers::pi;

}  // namespace

Run::Balance Run::balance() const {
  const Totals now = totals(chain_);
  const Chain::Flows flows = chain_.flows();
  Work work = work_;
  if (work.started) work.sample(now);
  const double gone = work.dissipated + flows.dissipated + flows.outflow;
  const double all =
      std::max({first_energy_, now.energy(), std::fabs(flows.supplied), std::fabs(gone), std::fabs(flows.by_contacts)});
  const double missing = now.energy() + gone - flows.supplied - flows.by_contacts - first_energy_;
  return {all > 0 ? std::fabs(missing) / all : 0, now.charge - first_charge_, now.dislocations, now.steepest};
}

void Run::check_energy(const Balance& balance, Findings& found) const {
  std::string sentence = "chain: energy and work differ by " + digits(balance.energy_drift) + " of the energy";
  if (scaled_.model == Model::sine_gordon) {
    const double sites = 2 / balance.steepest;  // a dislocation has the slope 2 over its width
    if (sites < least_sites_per_width)
      sentence += ". The narrowest dislocation, made so by its speed or by others, has only " + digits(sites, 2) +
                  " sites to its width; " + digits(least_sites_per_width) + " are needed";
    // The error is of fourth order in the spacing.
    const double finer = 0.9 * scaled_.spacing * std::pow(Findings::worth_a_warning / balance.energy_drift, 0.25);
    sentence += ". Try chain.spacing = " + digits(finer, 2);
  }
  found.violation(balance.energy_drift, sentence);
}

/// Nothing is faster than c.
void Run::check_fronts(Findings& found) const {
  const ScaledProblem& s = scaled_;
  const output::Snapshot& last = snapshots_.back();
  for (const auto& [name, x] : {std::pair{"leading", last.fronts.leading},
                                {"observed", last.fronts.leading_observed},
                                {"observed", last.fronts.trailing_observed}})
    if (x < s.left || x > s.right)
      found.violation(1, std::string("chain: the ") + name + " front at " + digits(x) + " is outside the domain");

  // A force makes dislocations anywhere, a free end lets others in, and around a ring they come back.
  const bool fixed = !s.boundary.periodic && s.boundary.left == End::fixed && s.boundary.right == End::fixed;
  if (s.forcing || s.loading.acts() || !fixed) return;
  const double site = chain_.problem().grid.spacing / s.scale;
  for (std::size_t i = 1; i < snapshots_.size(); ++i) {
    const output::Snapshot &before = snapshots_[i - 1], &now = snapshots_[i];
    const double gone = std::fabs(now.fronts.leading - before.fronts.leading), time = now.time - before.time;
    if (gone > time + site)
      found.violation((gone - site) / time - 1, "chain: the leading front is faster than c, " + digits(gone / time) +
                                                    " c between t = " + digits(before.time) + " and " +
                                                    digits(now.time));
  }
  // A step in a train that is even on either side moves first at x = 0; other profiles move everywhere at once.
  const bool step = !s.contact && s.stress(s.left) == s.stress(s.left / 1e6) &&
                    s.stress(s.right) == s.stress(s.right / 1e6) && s.stress(s.left / 2) == s.stress(s.left) &&
                    s.stress(s.right / 2) == s.stress(s.right);
  if (!step || !(s.left < 0 && s.right > 0)) return;
  const double cell = schedule_.x_edges.size() > 1 ? schedule_.x_edges[1] - schedule_.x_edges[0] : 0;
  const double allowed = last.time + std::fmax(smooth_window_ / 2, cell) + cell;
  for (const double x : {last.fronts.leading_observed, last.fronts.trailing_observed})
    if (std::fabs(x) > allowed)
      found.sentences.push_back("chain: an observed front at x = " + digits(x) +
                                " is farther from x = 0 than c carries it in t = " + digits(last.time) +
                                ": errors of the grid there exceed pulse.threshold = " + digits(schedule_.threshold) +
                                " of the peak slip velocity");
}

/// A dislocation in a train at rest feels the force dJ/dx (docs/theory.md 6) and F.
double Run::driving_force() const {
  const ScaledProblem& s = scaled_;
  constexpr int samples = 2000;
  const double dx = (s.right - s.left) / samples;
  double last = 0, by_stress = 0, by_forcing = 0;
  for (int i = 0; i <= samples; ++i) {
    const double x = s.left + dx * i, a = s.contact ? s.contact(x) : 1, k = s.stress(x);
    const double J = a * train::averages(train::at_rest(k / a)).J;
    if (i > 0) by_stress = std::fmax(by_stress, std::fabs(J - last) / dx);
    last = J;
    if (s.forcing)
      for (const double share : {0.0, 0.5, 1.0})
        by_forcing = std::fmax(by_forcing, std::fabs(s.forcing(x, share * schedule_.times.back())));
  }
  return by_stress + by_forcing;
}

/// A grid holds a dislocation that is pushed too little. Where the push is 20 times what the grid holds, the velocity
/// is some 0.1 % low.
void Run::check_barrier(Findings& found) const {
  constexpr double enough = 20;
  const ScaledProblem& s = scaled_;
  const double force = driving_force_ / s.scale, spacing = chain_.problem().grid.spacing;
  if (s.model != Model::sine_gordon || s.loading.acts() || !s.substrate || !(driving_force_ > 1e-9) ||
      force >= enough * barrier_force(spacing))
    return;
  found.sentences.push_back(
      "chain: the grid holds slow dislocations. The largest force on one, " + digits(driving_force_, 2) + ", is " +
      digits(force / barrier_force(spacing), 2) + " times the barrier of the grid at spacing " + digits(spacing, 3) +
      "; " + digits(enough) +
      " are needed. Try chain.spacing = " + digits(spacing_with_barrier_below(force / enough, spacing)));
}

/// Slip is u now less u at t = 0; the velocity at x = 0 was sampled on the way, by its own formula.
void Run::check_slip(Findings& found) const {
  if (std::isnan(first_u_at_origin_)) return;
  const double scale = scaled_.scale;
  if (slip_.samples > 7) {
    const Average now = average(chain_, 0, scale * window_, chain_.time());
    const double slip = now.u - first_u_at_origin_, by_velocity = slip_.up_to(chain_.time(), now.velocity);
    const double quarter = turn / 4;  // of a dislocation
    const double beyond = std::fabs(slip - by_velocity) - (3 * slip_.error() + quarter);
    found.violation(beyond / std::fmax(std::fabs(slip), turn), "chain: slip at x = 0 is " + digits(slip / scale) +
                                                                   ", the integral of the slip velocity there " +
                                                                   digits(by_velocity / scale));
  }
}

/// Where nothing makes antidislocations: dislocations counted where u passes pi, against those that the ends hold
/// apart, and |W| <= k.
void Run::check_one_sign(const Balance& balance, Findings& found) const {
  const ScaledProblem& s = scaled_;
  const bool closed = s.boundary.periodic || (s.boundary.left == End::fixed && s.boundary.right == End::fixed);
  if (!closed || s.forcing || s.loading.acts()) return;
  const auto counted = static_cast<double>(balance.dislocations);
  const double charge = std::fabs(first_charge_ + balance.charge_error);
  const double more = std::fabs(counted - charge) - 1.5;  // at a fixed end a part of one
  found.violation(more / std::fmax(charge, 100),
                  "chain: " + digits(counted) + " dislocations where the ends hold " + digits(charge));
  const output::Profile& last = snapshots_.back().profile;
  double k_most = 0, beyond = 0;
  for (std::size_t i = 0; i < last.k.size(); ++i) {
    k_most = std::fmax(k_most, std::fabs(last.k[i]));
    beyond = std::fmax(beyond, std::fabs(last.W[i]) - std::fabs(last.k[i]));
  }
  // Waves alone have a mean velocity of either sign, of the size of a share of a dislocation in the window.
  const double one = turn / (s.scale * smooth_window_);
  found.violation((beyond - 0.1 * one) / std::fmax(k_most, one),
                  "chain: the slip velocity is larger than the stress by " + digits(beyond));
}

output::Findings Run::findings() const {
  Findings found;
  if (snapshots_.empty()) return found;
  const Balance balance = this->balance();
  check_energy(balance, found);
  check_slip(found);
  check_one_sign(balance, found);
  check_fronts(found);
  check_barrier(found);

  const double last_slip = snapshots_.back().slip_at_origin, scale = scaled_.scale;
  if (!std::isnan(first_u_at_origin_) && last_slip != 0) {
    const double step = turn / scale, slip = std::fabs(last_slip);
    if (step / 4 > 0.01 * slip && slip > 1e-3 * step)
      found.sentences.push_back(
          "chain: " + digits(static_cast<double>(first_dislocations_)) + " dislocations at scale " + digits(scale) +
          ", of which " + digits(slip / step) + " passed x = 0; each is a slip of " + digits(step) +
          ". For 1 % try chain.scale = " + digits(std::pow(10, std::ceil(2 * std::log10(25 * turn / slip)) / 2)));
  }
  return found;
}

std::vector<std::string> Run::warnings() const {
  return final_findings_ ? final_findings_->sentences : findings().sentences;
}

void Run::refuse(const Findings& found) const {
  if (found.wrong_results()) throw NumericsError("t = " + digits(time()) + ": " + found.worst);
}

}  // namespace slipfront::chain
