#include "slipfront/event/posterior.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "../digits.hpp"
#include "sampler.hpp"
#include "slipfront/medium/medium.hpp"
#include "weighted.hpp"

namespace slipfront::event {
namespace {

[[noreturn]] void refuse_event(const Observation& o, const Sampler& sampler) {
  static constexpr std::array<std::array<const char*, 2>, refusals> reasons = {{
      {"rupture velocity not between 0 and c", "rupture_velocity < c"},
      {"the stress that this rupture velocity means is outside the table of friction",
       "stress in 0.05 ... 3 mu A / pi"},
      {"the slip velocity is above what any friction leaves at this rupture velocity and contact ratio",
       "a lower slip_velocity or a larger contact_ratio"},
      {"the slip velocity is below what a damping number of 1e8 leaves",
       "a higher slip_velocity or a smaller contact_ratio"},
      {"no contact ratio between 1e-8 and plastic contact agrees", "a lower slip_velocity, or another friction"},
      {"constants of the medium out of range", "-1 < poisson_ratio < 0.5, the others > 0"},
      {"the observations exclude each other", "observations within each other's errors"},
  }};
  const auto& refused = sampler.refused();
  const auto why = static_cast<std::size_t>(std::max_element(refused.begin(), refused.end()) - refused.begin());
  throw InputError({.file = o.file,
                    .line = o.line,
                    .problem = std::string("no state of the fault agrees with what was observed: ") + reasons[why][0],
                    .allowed = reasons[why][1]});
}

void add_trade_off(Posterior& p, const Observation& o, const MediumDefaults& defaults, modulation::Closure closure) {
  const Elastic e = elastic(o, defaults);
  const double time = o.rise_time ? o.rise_time->middle() : o.duration ? o.duration->middle() : 0;
  const double w = o.slip_velocity ? o.slip_velocity->middle() : o.slip->middle() / time;
  const double V = o.rupture_velocity->middle() / e.speed;
  if (!(V < 1)) return;
  const rupture::Relations r = rupture::from_rupture_velocity(V);
  const auto range = friction_ratio::stress_range();
  if (r.stress < range.least || r.stress > range.most) return;
  const Pulse pulse{r.stress, r.slip_velocity, o.slip_velocity_is, closure};
  for (const double damping : {0.0, 1.0, 10.0, 1e2, 1e3, 1e4, 1e6, 1e8}) {
    const double A = w / medium::slip_velocity_unit(e.speed, pulse.at(std::log1p(damping)).W);
    if (A <= medium::plastic_contact_ratio(e.poisson_ratio))
      p.trade_off.push_back({damping, A, medium::stress_unit(e.shear_modulus, A) * r.stress});
  }
}

void add_notes(Posterior& p, const Observation& o, const Sampler& s, modulation::Closure closure) {
  constexpr const char* cure =
      "contact_ratio, normal_stress with hardness, stress_drop, or friction_coefficient with asperity_spacing and "
      "duration would settle it";
  if (!s.knows_slip_velocity() && !s.fixes_friction())
    p.notes.push_back("damping_number is not identifiable without a slip velocity");
  if (!s.knows_contact() && !s.knows_slip_velocity())
    p.notes.push_back("contact_ratio and stress_pa are not identifiable without a slip velocity");
  if (s.knows_slip_velocity() && !s.knows_contact() && !s.knows_friction())
    p.notes.push_back(
        "contact_ratio and damping_number trade off: the velocities fix one of them when the other is known, their "
        "intervals are the prior's; " +
        std::string(cure));
  else if (p.damping_number_prior_share && *p.damping_number_prior_share > 0.5)
    p.notes.push_back("damping_number is known little better than before (prior's share " +
                      digits(*p.damping_number_prior_share, 4) +
                      "): smaller errors of slip_velocity and contact_ratio needed");
  if (s.fixes_friction() && !p.friction_coefficient)
    p.notes.push_back(std::string("friction_coefficient needs ") +
                      (!o.asperity_spacing ? "asperity_spacing" : "duration or rise_time") + " beside damping_number");
  if (o.contact_ratio && o.stress_drop && o.stress_drop->is_exact())
    p.notes.push_back("stress_drop not used: with a contact_ratio it needs an uncertainty");
  if (s.knows_contact() && s.knows_slip_velocity() && s.knows_friction() && o.friction_coefficient->is_exact())
    p.notes.push_back(
        "friction_coefficient not used: with a contact_ratio and a slip velocity it needs an uncertainty");
  if (p.effective_samples < 100 && p.effective_samples < 0.9 * static_cast<double>(p.samples))
    p.notes.push_back("only " + digits(p.effective_samples, 4) + " effective samples: more samples needed");
  if (p.damping_number && friction_ratio::uncertainty(closure, p.damping_number->median) > 1e-3)
    p.notes.push_back("closure paper is unstable at this damping number: its slip velocities are known to 1 %");
}

}  // namespace

bool speaks_of_friction_or_error(const Observation& o) {
  if (o.stress_drop || o.friction_coefficient || o.contact_ratio || (o.normal_stress && o.hardness) ||
      !o.uncertain_constants.empty())
    return true;
  for (const auto* m : {&o.rupture_velocity, &o.slip_velocity, &o.slip, &o.rise_time, &o.duration})
    if (*m && !(*m)->is_exact()) return true;
  return false;
}

std::optional<Posterior> posterior(const Observation& o, const MediumDefaults& defaults, const Sampling& sampling) {
  if (!o.rupture_velocity) return std::nullopt;
  Sampler sampler(o, defaults, sampling);
  std::vector<Sample> samples;
  samples.reserve(sampling.samples);
  double sum = 0, squares = 0;
  for (std::size_t i = 0; i < sampling.samples; ++i) {
    const Sample s = sampler.draw(i);
    if (!(s.weight > 0)) continue;
    samples.push_back(s);
    sum += s.weight;
    squares += s.weight * s.weight;
  }
  if (samples.empty()) refuse_event(o, sampler);

  Posterior p;
  p.samples = sampling.samples;
  p.seed = sampler.seed();
  p.effective_samples = sum / squares * sum;
  const auto of = [&](auto value) {
    std::vector<Weighted> values;
    values.reserve(samples.size());
    for (const Sample& s : samples) values.push_back({value(s), s.weight});
    return quantiles(std::move(values));
  };
  p.rupture_velocity = of([](const Sample& s) { return s.V; });
  p.stress = of([](const Sample& s) { return s.stress; });
  if (samples.front().contact_ratio > 0) {
    p.contact_ratio = of([](const Sample& s) { return s.contact_ratio; });
    p.stress_pa = of([](const Sample& s) { return s.stress_pa; });
    const double prior =
        0.9 * std::log(medium::plastic_contact_ratio(elastic(o, defaults).poisson_ratio) / least_contact_ratio);
    p.contact_ratio_prior_share = std::log(p.contact_ratio->high / p.contact_ratio->low) / prior;
  }
  if (sampler.fixes_friction()) {
    const Quantiles u = of([](const Sample& s) { return s.u; });
    p.damping_number = Quantiles{std::expm1(u.low), std::expm1(u.median), std::expm1(u.high)};
    p.friction_identified = sampler.knows_contact() || sampler.knows_friction();
    p.damping_number_prior_share = (u.high - u.low) / (0.9 * std::log1p(most_damping_number));
    if (sampler.knows_duration() && o.asperity_spacing)
      p.friction_coefficient = of([](const Sample& s) { return s.friction_coefficient; });
    if (!p.friction_identified) add_trade_off(p, o, defaults, sampling.closure);
  }
  add_notes(p, o, sampler, sampling.closure);
  return p;
}

}  // namespace slipfront::event
