#include "slipfront/events/inference/posterior.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <random>
#include <utility>

#include "events/inference/sampling/weighted_samples.hpp"
#include "events/inference/tension.hpp"
#include "math/digits.hpp"
#include "slipfront/theory/medium/medium.hpp"

namespace slipfront::inference {

using catalogue::Observation;
using catalogue::RuptureVelocityIs;
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
      {"the slip velocity is below that at every damping number up to 1e8",
       "a higher slip_velocity, a smaller contact_ratio, or another rupture_velocity_is"},
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

/// Samples of an event whose observations are exact. They are evenly spread over one unknown, the damping number.
constexpr std::size_t samples_of_damping = 64;
constexpr double least_effective_of_damping = 20;

/// Whether the only reason to reject the event is a contact ratio above plastic contact. Such an event gets a note
/// instead.
bool only_contact_refused(const Sampler& sampler) {
  const auto& refused = sampler.refused();
  return !sampler.knows_contact() && refused[bad_contact] > 0 &&
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
  const double seen = o.rupture_velocity_m_s->middle() / e.speed;
  const PulseModel model(o, closure);
  const double most_u = model.most_u(seen);
  for (const double damping : {0.0, 1.0, 10.0, 1e2, 1e3, 1e4, 1e6, 1e8}) {
    if (std::log1p(damping) > most_u) break;
    const PulseState pulse = model.at(seen, std::log1p(damping));
    const double A = w / medium::slip_velocity_unit(e.speed, pulse.W);
    if (A <= medium::plastic_contact_ratio(e.poisson_ratio))
      p.trade_off.push_back({damping, A, medium::stress_unit(e.shear_modulus, A) * pulse.stress});
  }
}

/// States which observations are in tension, and the stress without them.
void add_tension_notes(Posterior& p) {
  for (const Tension& t : p.tension) {
    std::string note = t.observation + " disagrees with the other observations";
    if (t.sigmas)
      note = t.observation + " is " + digits(std::fabs(*t.sigmas), 2) + " standard deviations " +
             (*t.sigmas > 0 ? "above" : "below") + " the prediction of the other observations";
    if (const auto& stress = t.without.stress_pa)
      note += "; without it, stress_pa is " + digits(stress->median, 3) + " (" + digits(stress->low, 3) + " to " +
              digits(stress->high, 3) + ")";
    p.notes.push_back(note);
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
  if (s.mode() == Mode::bounds && o.rupture_velocity_m_s && s.knows_slip_velocity() && !s.knows_contact())
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
  for (const std::string& name : s.unused())
    p.notes.push_back(name + " not used: two other exact observations determine the state; it needs an uncertainty");
  if (p.damping_number && friction_ratio::uncertainty(closure, p.damping_number->median) > 1e-3)
    p.notes.push_back("closure paper is unstable at this damping number: its slip velocities are known to 1 %");
}

/// Sets the quantiles of all quantities for which the samples suffice, and names the others.
void set_quantiles(Posterior& p, const WeightedSamples& samples) {
  for (const Quantity& q : quantities()) {
    const auto found = samples.quantiles(q.state);
    if (!found) continue;
    if (samples.tail_is_light() || samples.suffice_for(q.state, found->median))
      p.*q.quantiles = found;
    else
      p.notes.push_back("no interval of " + std::string(q.about.name) + ": a few samples dominate it");
  }
}

void set_predictions(Posterior& p, const Observation& o, const Sampler& sampler, const WeightedSamples& samples) {
  if (sampler.mode() != Mode::friction) return;
  if (o.rupture_velocity_m_s)
    p.predictions.push_back({"rupture_velocity", samples.below(*o.rupture_velocity_m_s, std::nullopt)});
  for (std::size_t i = 0; i < sampler.evidence().size(); ++i)
    p.predictions.push_back({sampler.evidence()[i].name, samples.below(sampler.evidence()[i].measured, i)});
}

/// Repeats the observations of the fault in a sample, with their errors.
ObservedValues repeated_of(const Sample& s, const Observation& o, const Sampler& sampler, std::mt19937_64& random) {
  ObservedValues all;
  all.fill(std::numeric_limits<double>::quiet_NaN());
  const Mode mode = sampler.mode();
  if (mode != Mode::friction && mode != Mode::contact) return all;
  const auto set = [&](std::string_view name, const catalogue::MeasuredValue& measured, double x) {
    const double probability = (static_cast<double>(random() >> 12) + 0.5) * 0x1p-52;
    all[position_of(name)] = repeated(measured, x, probability);
  };
  if (o.rupture_velocity_m_s) set("rupture_velocity", *o.rupture_velocity_m_s, s.state.rupture_velocity_m_s);
  const auto& evidence = sampler.evidence();
  for (std::size_t i = 0; i < std::min(evidence.size(), s.predicted.size()); ++i)
    if (mode == Mode::friction || evidence[i].source != Source::friction)
      set(evidence[i].name, evidence[i].measured, std::exp(s.predicted[i]));
  return all;
}

void set_draws(Posterior& p, const Observation& o, Sampler& sampler, const WeightedSamples& samples,
               std::size_t count) {
  std::mt19937_64 random(p.seed);
  for (const Sample* s : samples.draws(count)) {
    p.draws.push_back(s->state);
    p.repeated.push_back(repeated_of(*s, o, sampler, random));
  }
  p.prior_draws = sampler.draw_prior(count);
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

bool needs_samples(const Observation& o) {
  if (o.stress_drop || o.friction_coefficient || o.contact_ratio || (o.normal_stress && o.hardness) ||
      !o.uncertain_constants.empty())
    return true;
  for (const auto* m : {&o.rupture_velocity_m_s, &o.slip_velocity_m_s, &o.slip, &o.rise_time, &o.duration})
    if (*m && !(*m)->is_exact()) return true;
  return o.rupture_velocity_is == RuptureVelocityIs::front && o.rupture_velocity_m_s && o.has_slip_velocity();
}

namespace {

/// The samples of an event; none if its observations exclude each other.
WeightedSamples drawn(Sampler& sampler, const Sampling& sampling) {
  if (!(sampler.least_misfit() < hopeless_misfit)) return {};
  const bool few = sampler.knows_all_but_damping() && sampling.draws == 0;
  const std::size_t first = few ? std::min(sampling.samples, samples_of_damping) : sampling.samples;
  const std::size_t most = std::max(first, std::min(most_growth * first, most_samples));
  return draw_samples(sampler, first, most, few ? least_effective_of_damping : least_effective_samples);
}

}  // namespace

std::optional<Posterior> posterior(const Observation& o, const medium::Defaults& defaults, const Sampling& sampling) {
  Sampler sampler(o, defaults, sampling);
  if (sampler.mode() == Mode::nothing) return std::nullopt;
  Posterior p;
  p.samples = sampling.samples;
  p.seed = sampler.seed();
  const WeightedSamples samples = drawn(sampler, sampling);
  if (samples.drawn > 0) p.samples = samples.drawn;
  const bool suspicious = sampler.least_misfit() >= suspicious_misfit || samples.accepted.empty();
  if (suspicious && sampler.is_uncertain()) p.tension = tensions(o, defaults, sampling);
  add_tension_notes(p);
  if (samples.accepted.empty()) {
    if (p.tension.empty() && !only_contact_refused(sampler)) refuse_event(o, sampler);
    if (p.tension.empty())
      p.notes.push_back(
          "no intervals: no contact ratio up to plastic contact explains this slip velocity, even within its errors");
    p.contradicted = !p.tension.empty();
    return p;
  }
  p.effective_samples = samples.effective;
  p.pareto_k = sampler.is_uncertain() ? samples.pareto_k : 0;
  p.suffices = !sampler.is_uncertain() ||
               samples.suffice(sampler.knows_all_but_damping() ? least_effective_of_damping : least_effective_samples);
  p.friction_identified = sampler.fixes_friction();
  if (p.suffices) {
    set_quantiles(p, samples);
    set_prior_shares(p, o, defaults);
    set_predictions(p, o, sampler, samples);
    if (sampling.draws > 0) set_draws(p, o, sampler, samples, sampling.draws);
  } else {
    p.contradicted = !p.tension.empty();
    p.notes.push_back(why_no_interval(samples.effective, samples.pareto_k, p.samples));
  }
  if (sampler.knows_slip_velocity() && o.rupture_velocity_m_s && !sampler.fixes_friction())
    add_trade_off(p, o, defaults, sampling.closure);
  add_notes(p, o, sampler, sampling.closure);
  return p;
}

namespace {

/// The interval of samples. It is absent if all samples are equal.
std::optional<Interval> interval_of(const Quantiles& q) {
  if (!(q.low < q.high)) return {};
  return Interval{q.low, q.high};
}

}  // namespace

void apply_posterior(Estimate& e, const Posterior& p) {
  const auto set = [](std::optional<Inferred>& to, const std::optional<Quantiles>& from) {
    if (from) to = Inferred{from->median, interval_of(*from)};
  };
  for (const Quantity& q : quantities()) set(e.*q.inferred, p.*q.quantiles);
  // If only a bound is known, the bound is the result.
  if (!p.contact_ratio) set(e.contact_ratio, p.contact_ratio_bound);
  set(e.stress, p.stress_bound);
  if (p.contact_ratio) e.contact_ratio_bound.reset();
  if (p.stress_pa) e.stress_pa_bound.reset();
  // The closed forms only bound the stress if the error of the rupture velocity reaches above c. Samples are below c.
  if (p.stress && !p.stress_bound) e.stress_bound.reset();
  // An observation is not an answer: observations that exclude each other give none.
  if (p.contradicted)
    for (auto* x : {&e.contact_ratio, &e.stress_pa, &e.observed_slip_velocity, &e.slip_velocity_ratio,
                    &e.contact_ratio_bound, &e.stress_pa_bound})
      x->reset();
  if (p.suffices) return;
  for (const Quantity& q : quantities())
    if (e.*q.inferred) (e.*q.inferred)->interval.reset();
}

}  // namespace slipfront::inference
