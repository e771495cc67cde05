#include "slipfront/inference/posterior.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "foundation/text/digits.hpp"
#include "inference/pareto.hpp"
#include "inference/sampler.hpp"
#include "inference/weighted.hpp"
#include "slipfront/medium/medium.hpp"

namespace slipfront::inference {

using catalogue::Observation;
using medium::Elastic;
using medium::elastic;

namespace {

[[noreturn]] void refuse_event(const Observation& o, const Sampler& sampler) {
  static constexpr std::array<std::array<const char*, 2>, refusals> reasons = {{
      {"rupture velocity not between 0 and c", "rupture_velocity < c"},
      {"the stress that follows from this rupture velocity is outside the table of friction",
       "stress in 0.05 ... 3 mu A / pi"},
      {"the slip velocity is above that without friction at this rupture velocity and contact ratio",
       "a lower slip_velocity or a larger contact_ratio"},
      {"the slip velocity is below that at a damping number of 1e8",
       "a higher slip_velocity or a smaller contact_ratio"},
      {"no contact ratio between 1e-8 and plastic contact agrees with the observations",
       "a lower slip_velocity, or another friction"},
      {"constants of the medium out of range", "-1 < poisson_ratio < 0.5, the others > 0"},
      {"the observations contradict each other", "observations that agree within their errors"},
  }};
  const auto& refused = sampler.refused();
  const auto why = static_cast<std::size_t>(std::max_element(refused.begin(), refused.end()) - refused.begin());
  throw InputError({.file = o.file,
                    .line = o.line,
                    .problem = std::string("no state of the fault agrees with the observations: ") + reasons[why][0],
                    .allowed = reasons[why][1]});
}

/// Whether the only reason to reject the event is a contact ratio above plastic contact. Such an event gets a note
/// instead.
bool only_contact_refused(const Sampler& sampler) {
  const auto& refused = sampler.refused();
  return !sampler.fixes_friction() && !sampler.knows_contact() && refused[bad_contact] > 0 &&
         std::max_element(refused.begin(), refused.end()) - refused.begin() == bad_contact;
}

std::string why_no_interval(double effective, double k, std::size_t samples) {
  const std::string of = " of " + std::to_string(samples);
  if (effective < least_effective_samples)
    return "no intervals: only " + digits(effective, 3) + " effective samples" + of + ", but " +
           digits(least_effective_samples) + " are needed; the observations hardly agree with each other";
  return "no intervals: Pareto k-hat of the weights is " + digits(k, 3) + " with" + of.substr(3) +
         " samples, above 0.7: a few samples dominate";
}

void add_trade_off(Posterior& p, const Observation& o, const medium::Defaults& defaults, friction::Closure closure) {
  const Elastic e = elastic(o, defaults);
  const double w = o.slip_velocity_m_s ? o.slip_velocity_m_s->middle() : o.slip->middle() / o.slip_time()->middle();
  const double V = o.rupture_velocity_m_s->middle() / e.speed;
  if (!(V < 1)) return;
  const rupture::Relations r = rupture::from_rupture_velocity(V);
  const auto range = friction_ratio::stress_range();
  if (r.stress < range.least || r.stress > range.most) return;
  const Pulse pulse{r.stress, r.slip_velocity, o.measure(), closure};
  for (const double damping : {0.0, 1.0, 10.0, 1e2, 1e3, 1e4, 1e6, 1e8}) {
    const double A = w / medium::slip_velocity_unit(e.speed, pulse.at(std::log1p(damping)).W);
    if (A <= medium::plastic_contact_ratio(e.poisson_ratio))
      p.trade_off.push_back({damping, A, medium::stress_unit(e.shear_modulus, A) * r.stress});
  }
}

/// States in words how much of an interval comes from the prior.
std::string share_in_words(const char* name, double share) {
  const std::string text(name);
  if (share > 0.5)
    return text +
           ": the prior determines most of the interval (its share is above 50 %); smaller errors of slip_velocity "
           "and contact_ratio are needed";
  if (share > 0.1) return text + ": data and prior determine the interval (the share of the prior is 10 to 50 %)";
  return text + ": the data determine the interval (the share of the prior is below 10 %)";
}

void add_notes(Posterior& p, const Observation& o, const Sampler& s, friction::Closure closure) {
  constexpr const char* cure =
      "contact_ratio, normal_stress with hardness, stress_drop, or friction_coefficient with asperity_spacing and "
      "duration would separate them";
  if (!s.knows_slip_velocity() && !s.fixes_friction())
    p.notes.push_back("damping_number is not identifiable without a slip velocity");
  if (!s.knows_contact() && !s.knows_slip_velocity())
    p.notes.push_back("contact_ratio and stress_pa are not identifiable without a slip velocity");
  if (o.rupture_velocity_m_s && s.knows_slip_velocity() && !s.fixes_friction())
    p.notes.push_back(
        "contact_ratio and damping_number trade off: the velocities fix one of them if the other is known, and above "
        "the bounds only the prior decides; " +
        std::string(cure));
  if (p.damping_number_prior_share && p.damping_number && s.is_uncertain())
    p.notes.push_back(share_in_words("damping_number", *p.damping_number_prior_share));
  if (p.contact_ratio_prior_share && p.contact_ratio && !s.knows_contact() && s.is_uncertain())
    p.notes.push_back(share_in_words("contact_ratio", *p.contact_ratio_prior_share));
  if (s.fixes_friction() && !(s.knows_duration() && o.asperity_spacing))
    p.notes.push_back(std::string("friction_coefficient needs ") +
                      (!o.asperity_spacing ? "asperity_spacing" : "duration or rise_time") +
                      " in addition to damping_number");
  if (o.contact_ratio && o.stress_drop && o.stress_drop->is_exact())
    p.notes.push_back("stress_drop not used: with a contact_ratio it needs an uncertainty");
  if (s.knows_contact() && s.knows_slip_velocity() && s.knows_friction() && o.friction_coefficient->is_exact())
    p.notes.push_back(
        "friction_coefficient not used: with a contact_ratio and a slip velocity it needs an uncertainty");
  if (p.damping_number && friction_ratio::uncertainty(closure, p.damping_number->median) > 1e-3)
    p.notes.push_back("closure paper is unstable at this damping number: its slip velocities are known to 1 %");
}

/// The accepted samples, and whether they are enough.
struct Samples {
  std::vector<Sample> accepted;
  double effective = 0, pareto_k = 0;

  bool suffice() const {
    return effective >= least_effective_samples && pareto_k <= most_pareto_k(static_cast<double>(accepted.size()));
  }
};

void weigh(Samples& s) {
  double sum = 0, squares = 0;
  std::vector<double> weights;
  weights.reserve(s.accepted.size());
  for (const Sample& sample : s.accepted) {
    sum += sample.weight;
    squares += sample.weight * sample.weight;
    weights.push_back(sample.weight);
  }
  s.effective = sum / squares * sum;
  s.pareto_k = pareto_k(std::move(weights));
}

/// Doubles the number of samples until they suffice or the limit is reached. It also stops when even the limit would
/// not give enough effective samples.
Samples drawn(Sampler& sampler, std::size_t first, std::size_t& count) {
  const std::size_t most = std::max(first, std::min(most_growth * first, most_samples));
  Samples s;
  for (std::size_t begin = 0;; begin = count, count = std::min(2 * count, most)) {
    sampler.grow(count);
    for (std::size_t i = begin; i < count; ++i)
      if (const Sample sample = sampler.draw(i); sample.weight > 0) s.accepted.push_back(sample);
    if (!sampler.is_uncertain()) {
      s.effective = static_cast<double>(s.accepted.size());
      return s;
    }
    if (!s.accepted.empty()) weigh(s);
    // The number of effective samples grows with the number of samples. We allow a factor of 4 for events that the
    // first few samples misjudge.
    const double promised = 4 * s.effective * static_cast<double>(most) / static_cast<double>(count);
    if (s.suffice() || count == most || (count >= 8 * first && promised < least_effective_samples)) return s;
  }
}

/// Sets the quantiles of all known quantities. Most rise or fall together with the one before, so we sort the samples
/// again only if their order changes.
void set_quantiles(Posterior& p, const std::vector<Sample>& samples) {
  std::vector<const Sample*> order;
  order.reserve(samples.size());
  for (const Sample& s : samples) order.push_back(&s);
  std::vector<Weighted> values(samples.size());
  for (const Quantity& q : quantities()) {
    if (std::isnan(samples.front().state.*q.state)) continue;
    const auto below = [&](const Sample* a, const Sample* b) { return a->state.*q.state < b->state.*q.state; };
    if (!std::is_sorted(order.begin(), order.end(), below)) std::sort(order.begin(), order.end(), below);
    for (std::size_t i = 0; i < order.size(); ++i) values[i] = {order[i]->state.*q.state, order[i]->weight};
    p.*q.quantiles = weighted_quantiles(values);
  }
}

/// States of equal weight, by systematic resampling.
std::vector<FaultState> draws_of(const std::vector<Sample>& samples, std::size_t count) {
  double total = 0, below = 0;
  for (const Sample& s : samples) total += s.weight;
  std::vector<FaultState> draws;
  for (const Sample& s : samples) {
    below += s.weight;
    while (draws.size() < count &&
           (static_cast<double>(draws.size()) + 0.5) * total <= below * static_cast<double>(count))
      draws.push_back(s.state);
  }
  while (draws.size() < count) draws.push_back(samples.back().state);
  return draws;
}

void set_prior_shares(Posterior& p, const Observation& o, const medium::Defaults& defaults) {
  if (p.contact_ratio) {
    const double prior =
        0.9 * std::log(medium::plastic_contact_ratio(elastic(o, defaults).poisson_ratio) / least_contact_ratio);
    p.contact_ratio_prior_share = std::log(p.contact_ratio->high / p.contact_ratio->low) / prior;
  }
  if (p.damping_number)
    p.damping_number_prior_share = (std::log1p(p.damping_number->high) - std::log1p(p.damping_number->low)) /
                                   (0.9 * std::log1p(most_damping_number));
  if (p.contact_ratio_bound) p.contact_ratio_prior_share = p.damping_number_prior_share = 1;
}

}  // namespace

bool speaks_of_friction_or_error(const Observation& o) {
  if (o.stress_drop || o.friction_coefficient || o.contact_ratio || (o.normal_stress && o.hardness) ||
      !o.uncertain_constants.empty())
    return true;
  for (const auto* m : {&o.rupture_velocity_m_s, &o.slip_velocity_m_s, &o.slip, &o.rise_time, &o.duration})
    if (*m && !(*m)->is_exact()) return true;
  return false;
}

std::optional<Posterior> posterior(const Observation& o, const medium::Defaults& defaults, const Sampling& sampling) {
  Sampler sampler(o, defaults, sampling);
  if (!sampler.knows_anything()) return std::nullopt;
  Posterior p;
  p.samples = sampling.samples;
  p.seed = sampler.seed();
  const Samples samples = drawn(sampler, sampling.samples, p.samples);
  if (samples.accepted.empty()) {
    if (!only_contact_refused(sampler)) refuse_event(o, sampler);
    p.notes.push_back(
        "no intervals: no contact ratio up to plastic contact explains this slip velocity, even within its errors");
    return p;
  }
  p.effective_samples = samples.effective;
  p.pareto_k = samples.pareto_k;
  p.suffices = !sampler.is_uncertain() || samples.suffice();
  p.friction_identified = sampler.fixes_friction();
  if (p.suffices) {
    set_quantiles(p, samples.accepted);
    set_prior_shares(p, o, defaults);
    p.draws = draws_of(samples.accepted, sampling.draws);
  } else {
    p.notes.push_back(why_no_interval(samples.effective, samples.pareto_k, p.samples));
  }
  if (sampler.knows_slip_velocity() && o.rupture_velocity_m_s && !sampler.fixes_friction())
    add_trade_off(p, o, defaults, sampling.closure);
  add_notes(p, o, sampler, sampling.closure);
  return p;
}

}  // namespace slipfront::inference
