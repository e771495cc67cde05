// What a chain run should obey whatever it computes, and what is said or done where it does not.

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <utility>

#include "../digits.hpp"
#include "slipfront/chain/run.hpp"
#include "slipfront/error.hpp"

namespace slipfront::chain {
namespace {

constexpr double turn = 2 * std::numbers::pi;
constexpr double worth_a_warning = 1e-3, wrong = 1e-2;  // relative

}  // namespace

/// Sentences, and the worst of them where it is more than a doubt.
struct Run::Findings {
  std::vector<std::string> sentences;
  std::string worst;
  double size = 0;

  void violation(double relative, const std::string& sentence) {
    if (relative <= worth_a_warning) return;  // NaN goes on
    sentences.push_back(sentence);
    if (relative <= size) return;
    size = std::isnan(relative) ? HUGE_VAL : relative;
    worst = sentence;
  }
};

Run::Balance Run::balance() const {
  const Totals now = totals(chain_);
  const Chain::Flows flows = chain_.flows();
  Work work = work_;
  if (work.started) work.sample(now);
  const double gone = work.dissipated + flows.dissipated + flows.outflow;
  const double all = std::max({first_energy_, now.energy(), std::fabs(flows.supplied), std::fabs(gone)});
  const double missing = now.energy() + gone - flows.supplied - first_energy_;
  return {all > 0 ? std::fabs(missing) / all : 0, now.charge - first_charge_, now.dislocations};
}

Run::Findings Run::findings() const {
  Findings found;
  if (snapshots_.empty()) return found;
  const pulse::Snapshot& last = snapshots_.back();
  const Stretched& s = stretched_;
  const Balance balance = this->balance();
  found.violation(balance.energy_drift, "chain: energy and work differ by " + digits(balance.energy_drift) +
                                            " of the energy; a finer chain.spacing helps");

  // Slip is u now less u at t = 0; the velocity at x = 0 was sampled on the way, by its own formula.
  const bool at_origin = !std::isnan(first_u_at_origin_);
  if (at_origin && passed_.samples > 8) {
    const Average now = average(chain_, 0, s.scale * window_, chain_.time());
    const double rest = (chain_.time() - passed_.time) * (now.velocity + passed_.velocity) / 2;
    const double slip = now.u - first_u_at_origin_, by_velocity = passed_.slip + rest;
    // Slow errors of the sum are seen by every other sample, waves faster than the samples by their spread.
    const double doubt = 3 * std::fabs(passed_.slip - passed_.coarse_slip) + 3 * std::sqrt(passed_.spread) +
                         turn / 4;  // a quarter of a dislocation
    const double beyond = std::fabs(slip - by_velocity) - doubt;
    found.violation(beyond / std::fmax(std::fabs(slip), turn), "chain: slip at x = 0 is " + digits(slip / s.scale) +
                                                                   ", the integral of the slip velocity there " +
                                                                   digits(by_velocity / s.scale));
  }

  // Dislocations counted where u passes pi, against those that the ends hold apart.
  const bool closed = s.boundary.periodic || (s.boundary.left == End::fixed && s.boundary.right == End::fixed);
  const bool one_sign = closed && !s.forcing;
  if (one_sign) {
    const auto counted = static_cast<double>(balance.dislocations);
    const double charge = std::fabs(first_charge_ + balance.charge_error);
    const double more = std::fabs(counted - charge) - 1.5;  // at a fixed end a part of one
    found.violation(more / std::fmax(charge, 100),
                    "chain: " + digits(counted) + " dislocations where the ends hold " + digits(charge));
    double k_most = 0, beyond = 0;
    for (std::size_t i = 0; i < last.profile.k.size(); ++i) {
      k_most = std::fmax(k_most, std::fabs(last.profile.k[i]));
      beyond = std::fmax(beyond, std::fabs(last.profile.W[i]) - std::fabs(last.profile.k[i]));
    }
    // Waves alone have a mean velocity of either sign, of the size of a share of a dislocation in the window.
    const double one = turn / (s.scale * smooth_window_);
    found.violation((beyond - 0.1 * one) / std::fmax(k_most, one),
                    "chain: the slip velocity is larger than the stress by " + digits(beyond));
  }

  for (const auto& [name, x] : {std::pair{"leading", last.fronts.leading},
                                {"observed", last.fronts.leading_observed},
                                {"observed", last.fronts.trailing_observed}})
    if (x < s.left || x > s.right)
      found.violation(1, std::string("chain: the ") + name + " front at " + digits(x) + " is outside the domain");

  if (at_origin && last.slip_at_origin != 0) {
    const double step = turn / s.scale, slip = std::fabs(last.slip_at_origin);
    if (step / 4 > 0.01 * slip && slip > 1e-3 * step)
      found.sentences.push_back(
          "chain: " + digits(static_cast<double>(first_dislocations_)) + " dislocations at scale " + digits(s.scale) +
          ", of which " + digits(slip / step) + " passed x = 0; each is a slip of " + digits(step) +
          ". For 1 % try chain.scale = " + digits(std::pow(10, std::ceil(2 * std::log10(25 * turn / slip)) / 2)));
  }
  return found;
}

std::vector<std::string> Run::warnings() const { return findings().sentences; }

void Run::refuse_wrong_results() const {
  const Findings found = findings();
  if (found.size > wrong) throw NumericsError("t = " + digits(time()) + ": " + found.worst);
}

}  // namespace slipfront::chain
