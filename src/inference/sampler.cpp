#include "inference/sampler.hpp"

#include <cmath>

#include "slipfront/medium/medium.hpp"

namespace slipfront::inference {

using catalogue::Measured;
using catalogue::Observation;
using catalogue::UncertainConstant;
using medium::elastic;

Sampler::Sampler(const Observation& o, const medium::Defaults& defaults, const Sampling& sampling)
    : o_(o),
      defaults_(defaults),
      sampling_(sampling),
      seed_(seed_of(sampling.seed, o.name, o.line)),
      points_(sampling.samples, seed_),
      time_(o.damping_time()),
      slip_time_(o.slip_time()),
      constants_(static_cast<const medium::Constants&>(o)),
      elastic_(elastic(o, defaults)),
      plastic_(medium::plastic_contact_ratio(elastic_.poisson_ratio)) {
  for (const UncertainConstant& c : o.uncertain_constants)
    if (c.member == &medium::Constants::contact_ratio) contact_measured_ = &c.measured;
  contact_from_ = o.contact_ratio                           ? ContactFrom::ratio
                  : o.stress_drop && o.rupture_velocity_m_s ? ContactFrom::drop
                  : o.normal_stress && o.hardness           ? ContactFrom::strength
                                                            : ContactFrom::nothing;
}

bool Sampler::draw_constants() {
  std::size_t dimension = 6;
  bool moved = false;
  for (const UncertainConstant& c : o_.uncertain_constants) {
    if (&c.measured == contact_measured_) continue;
    const double value = at(c.measured, dimension++);
    if (!(value > 0) && c.member != &medium::Constants::poisson_ratio) return false;
    constants_.*c.member = value;
    moved = moved || c.member != &medium::Constants::asperity_spacing;
  }
  if (!moved) return true;
  try {
    elastic_ = elastic(constants_, defaults_);
    plastic_ = medium::plastic_contact_ratio(elastic_.poisson_ratio);
  } catch (const InputError&) {
    return false;
  }
  return true;
}

/// Draws A from the observation that gives it. The prior is uniform in ln A, so `weight_of_draw` corrects for the
/// density of the draw.
bool Sampler::draw_contact(Sample& s) {
  switch (contact_from_) {
    case ContactFrom::ratio:
      s.state.contact_ratio = contact_measured_ ? at(*contact_measured_, 3) : *o_.contact_ratio;
      if (contact_measured_) s.weight *= contact_measured_->weight_of_draw(s.state.contact_ratio);
      break;
    case ContactFrom::drop: {
      const double drop = at(*o_.stress_drop, 3);
      s.state.contact_ratio = drop / medium::stress_unit(elastic_.shear_modulus, 1) / s.state.stress;
      s.weight *= o_.stress_drop->weight_of_draw(drop);
      break;
    }
    case ContactFrom::strength:
      s.state.contact_ratio = plastic_ * at(*o_.normal_stress, 3) / at(*o_.hardness, 4);
      break;
    case ContactFrom::nothing:
      return true;
  }
  return (s.state.contact_ratio >= least_contact_ratio && s.state.contact_ratio <= plastic_) || refuse(bad_contact);
}

/// Computes the damping number from the slip velocity w, and also A if it is not known yet.
bool Sampler::draw_friction(Sample& s, double w) {
  const double unit = medium::slip_velocity_unit(elastic_.speed, 1);
  const double most_u = std::log1p(most_damping_number);
  if (knows_contact()) {  // (V, w, A) -> Gamma; the prior is uniform in u, but we drew w
    const auto found = damping_at(pulse_, w / (unit * s.state.contact_ratio));
    if (!found) return refuse(w > unit * s.state.contact_ratio * pulse_.at(0).W ? slips_too_fast : slips_too_slowly);
    s.u = found->u;
    s.weight /= std::fabs(found->slope);
  } else if (knows_friction()) {  // (V, w, C) -> A and Gamma; d(ln w, ln C) / d(ln A, ln Gamma) = 1 + d ln W / d ln
                                  // Gamma
    const double C = at(*o_.friction_coefficient, 5);
    if (!(C > 0)) return refuse(contradicted);
    const auto found = contact_at(pulse_, w / unit, C * duration_ * elastic_.speed / *constants_.asperity_spacing,
                                  least_contact_ratio, plastic_);
    if (!found) return refuse(bad_contact);
    s.state.contact_ratio = found->contact_ratio;
    s.u = found->u;
    if (s.u > most_u) return refuse(slips_too_slowly);
    const double share = -std::expm1(-s.u);  // Gamma / (1 + Gamma) = du / d ln Gamma
    s.weight *= share / (1 + found->slope * share) * o_.friction_coefficient->weight_of_draw(C);
  }
  return true;
}

bool Sampler::is_uncertain() const {
  for (const auto* m : {&o_.rupture_velocity_m_s, &o_.slip_velocity_m_s, &o_.slip, &o_.rise_time, &o_.duration,
                        &o_.friction_coefficient, &o_.stress_drop, &o_.normal_stress, &o_.hardness})
    if (*m && !(*m)->is_exact()) return true;
  return !o_.uncertain_constants.empty();
}

/// Multiplies the weight by the likelihood of the observations that were not drawn from.
bool Sampler::agrees(Sample& s) const {
  const auto weigh = [&](const Measured& m, double value) {
    if (m.is_exact()) return;  // it has no likelihood; a note states that it was not used
    s.weight *= m.likelihood(value);
  };
  if (contact_from_ == ContactFrom::ratio && o_.stress_drop && o_.rupture_velocity_m_s)
    weigh(*o_.stress_drop, s.state.stress_pa);
  if (fixes_friction() && knows_contact() && knows_slip_velocity() && knows_friction())
    weigh(*o_.friction_coefficient, s.state.friction_coefficient);
  return s.weight > 0 && std::isfinite(s.weight);
}

bool Sampler::draw_rupture_velocity(Sample& s) {
  FaultState& state = s.state;
  state.rupture_velocity_m_s = at(*o_.rupture_velocity_m_s, 0);
  state.rupture_velocity = state.rupture_velocity_m_s / elastic_.speed;
  if (!(state.rupture_velocity > 0 && state.rupture_velocity < 1)) return refuse(too_fast);
  s.weight = o_.rupture_velocity_m_s->weight_of_draw(state.rupture_velocity_m_s);
  const rupture::Relations r = rupture::from_rupture_velocity(state.rupture_velocity);
  state.stress = r.stress;
  state.frictionless_slip_velocity = r.slip_velocity;
  pulse_ = {r.stress, r.slip_velocity, o_.measure(), sampling_.closure};
  return true;
}

bool Sampler::draw_times() {
  if (time_) duration_ = at(*time_, 2);
  if (slip_time_) slipping_ = slip_time_ == time_ ? duration_ : at(*slip_time_, 12);
  return ((!time_ || duration_ > 0) && (!slip_time_ || slipping_ > 0)) || refuse(contradicted);
}

std::optional<double> Sampler::draw_slip_velocity(Sample& s) {
  const Measured& slip = o_.slip_velocity_m_s ? *o_.slip_velocity_m_s : *o_.slip;
  const double drawn = at(slip, 1);
  if (!(drawn > 0)) {
    refuse(contradicted);
    return std::nullopt;
  }
  s.weight *= slip.weight_of_draw(drawn);
  return o_.slip_velocity_m_s ? drawn : drawn / slipping_;
}

/// Computes Gamma, and A if it is not known yet.
bool Sampler::find_friction(Sample& s, std::optional<double> w) {
  const auto range = friction_ratio::stress_range();
  if (!(s.state.stress >= range.least && s.state.stress <= range.most)) return refuse(off_table);
  if (w) {
    if (!draw_friction(s, *w)) return false;
  } else {
    const double C = at(*o_.friction_coefficient, 5);
    if (!(C > 0)) return refuse(contradicted);
    s.u = std::log1p(C * duration_ * elastic_.speed * s.state.contact_ratio / *constants_.asperity_spacing);
    s.weight *= -std::expm1(-s.u) * o_.friction_coefficient->weight_of_draw(C);
  }
  s.state.damping_number = std::expm1(s.u);
  if (time_ && constants_.asperity_spacing)
    s.state.friction_coefficient =
        s.state.damping_number * *constants_.asperity_spacing / (duration_ * elastic_.speed * s.state.contact_ratio);
  return true;
}

/// Computes a lower bound, which exists because friction can only slow slip. It is the bound of A if the rupture
/// velocity is known, and of Sigma- if A is known.
bool Sampler::find_bound(Sample& s, double w) {
  FaultState& state = s.state;
  if (o_.rupture_velocity_m_s) {
    const double W = frictionless(o_.measure(), state.stress, state.frictionless_slip_velocity);
    state.contact_ratio_bound = w / medium::slip_velocity_unit(elastic_.speed, W);
    return state.contact_ratio_bound <= plastic_ || refuse(bad_contact);
  }
  state.stress_bound =
      rupture::from_slip_velocity(w / medium::slip_velocity_unit(elastic_.speed, state.contact_ratio)).stress;
  return true;
}

Sample Sampler::draw(std::size_t i) {
  point_ = i;
  Sample s{1, 0, unknown_state()};
  std::optional<double> w;
  if (!draw_constants()) {
    refuse(bad_constants);
    return {};
  }
  if (o_.rupture_velocity_m_s && !draw_rupture_velocity(s)) return {};
  if (!draw_contact(s) || !draw_times()) return {};
  if (knows_slip_velocity() && !(w = draw_slip_velocity(s))) return {};
  if (fixes_friction() ? !find_friction(s, w) : w && !find_bound(s, *w)) return {};
  derive(s.state, elastic_, knows_contact() ? w : std::nullopt);
  if (agrees(s)) return s;
  refuse(contradicted);
  return {};
}

}  // namespace slipfront::inference
