#include "sampler.hpp"

#include <cmath>

#include "slipfront/medium/medium.hpp"

namespace slipfront::event {

Sampler::Sampler(const Observation& o, const MediumDefaults& defaults, const Sampling& sampling)
    : o_(o),
      defaults_(defaults),
      sampling_(sampling),
      seed_(seed_of(sampling.seed, o.name, o.line)),
      points_(sampling.samples, seed_),
      time_(o.slip_velocity ? (o.duration    ? &*o.duration
                               : o.rise_time ? &*o.rise_time
                                             : nullptr)
            : o.rise_time   ? &*o.rise_time
            : o.duration    ? &*o.duration
                            : nullptr),
      constants_(static_cast<const medium::Constants&>(o)),
      elastic_(elastic(o, defaults)),
      plastic_(medium::plastic_contact_ratio(elastic_.poisson_ratio)) {
  for (const UncertainConstant& c : o.uncertain_constants)
    if (c.member == &medium::Constants::contact_ratio) contact_measured_ = &c.measured;
  contact_from_ = o.contact_ratio                 ? ContactFrom::ratio
                  : o.stress_drop                 ? ContactFrom::drop
                  : o.normal_stress && o.hardness ? ContactFrom::strength
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

/// A from whichever observation gives it. Flat in ln A, so the weight loses what was drawn.
bool Sampler::draw_contact(Sample& s) {
  switch (contact_from_) {
    case ContactFrom::ratio:
      s.contact_ratio = contact_measured_ ? at(*contact_measured_, 3) : *o_.contact_ratio;
      if (contact_measured_) s.weight *= contact_measured_->weight_of_draw(s.contact_ratio);
      break;
    case ContactFrom::drop: {
      const double drop = at(*o_.stress_drop, 3);
      s.contact_ratio = drop / medium::stress_unit(elastic_.shear_modulus, 1) / s.stress;
      s.weight *= o_.stress_drop->weight_of_draw(drop);
      break;
    }
    case ContactFrom::strength:
      s.contact_ratio = plastic_ * at(*o_.normal_stress, 3) / at(*o_.hardness, 4);
      break;
    case ContactFrom::nothing:
      return true;
  }
  return (s.contact_ratio >= least_contact_ratio && s.contact_ratio <= plastic_) || refuse(bad_contact);
}

/// The damping number, and A where it is not known yet, from the slip velocity w.
bool Sampler::draw_friction(Sample& s, double w) {
  const double unit = medium::slip_velocity_unit(elastic_.speed, 1);
  const double most_u = std::log1p(most_damping_number);
  if (knows_contact()) {  // (V, w, A) -> Gamma; the prior is flat in u, the draw was in w
    const auto found = damping_at(pulse_, w / (unit * s.contact_ratio));
    if (!found) return refuse(w > unit * s.contact_ratio * pulse_.at(0).W ? slips_too_fast : slips_too_slowly);
    s.u = found->u;
    s.weight /= std::fabs(found->slope);
  } else if (knows_friction()) {  // (V, w, C) -> A and Gamma; d(ln w, ln C) / d(ln A, ln Gamma) = 1 + d ln W / d ln
                                  // Gamma
    const double C = at(*o_.friction_coefficient, 5);
    if (!(C > 0)) return refuse(contradicted);
    const auto found = contact_at(pulse_, w / unit, C * duration_ * elastic_.speed / *constants_.asperity_spacing,
                                  least_contact_ratio, plastic_);
    if (!found) return refuse(bad_contact);
    s.contact_ratio = found->contact_ratio;
    s.u = found->u;
    if (s.u > most_u) return refuse(slips_too_slowly);
    const double share = -std::expm1(-s.u);  // Gamma / (1 + Gamma) = du / d ln Gamma
    s.weight *= share / (1 + found->slope * share) * o_.friction_coefficient->weight_of_draw(C);
  } else {  // (V, w, u) -> A
    s.u = points_(point_, 5) * most_u;
    s.contact_ratio = w / (unit * pulse_.at(s.u).W);
    if (!(s.contact_ratio >= least_contact_ratio && s.contact_ratio <= plastic_)) return refuse(bad_contact);
  }
  return true;
}

/// Observations that were not drawn from weigh the sample.
bool Sampler::agrees(Sample& s) const {
  const auto weigh = [&](const Measured& m, double value) {
    if (m.is_exact()) return;  // cannot weigh: a note says that it was not used
    s.weight *= m.likelihood(value);
  };
  if (contact_from_ == ContactFrom::ratio && o_.stress_drop) weigh(*o_.stress_drop, s.stress_pa);
  if (knows_contact() && knows_slip_velocity() && knows_friction())
    weigh(*o_.friction_coefficient, s.friction_coefficient);
  return s.weight > 0 && std::isfinite(s.weight);
}

Sample Sampler::draw(std::size_t i) {
  point_ = i;
  Sample s{};
  const auto nothing = [&](Refusal why) {
    refuse(why);
    return Sample{};
  };
  if (!draw_constants()) return nothing(bad_constants);
  s.V = at(*o_.rupture_velocity, 0);
  if (!(s.V > 0 && s.V < elastic_.speed)) return nothing(too_fast);
  s.weight = o_.rupture_velocity->weight_of_draw(s.V);
  const rupture::Relations r = rupture::from_rupture_velocity(s.V / elastic_.speed);
  s.stress = r.stress;
  pulse_ = {r.stress, r.slip_velocity, o_.slip_velocity_is, sampling_.closure};
  if (!draw_contact(s)) return {};
  if (time_) duration_ = at(*time_, 2);
  if (time_ && !(duration_ > 0)) return nothing(contradicted);
  const auto range = friction_ratio::stress_range();
  const bool tabled = s.stress >= range.least && s.stress <= range.most;
  if (fixes_friction()) {
    if (!tabled) return nothing(off_table);
    if (knows_slip_velocity()) {
      const Measured& slip = o_.slip_velocity ? *o_.slip_velocity : *o_.slip;
      const double drawn = at(slip, 1), w = o_.slip_velocity ? drawn : drawn / duration_;
      if (!(w > 0)) return nothing(contradicted);
      s.weight *= slip.weight_of_draw(drawn);
      if (!draw_friction(s, w)) return {};
    } else {
      const double C = at(*o_.friction_coefficient, 5);
      s.u = std::log1p(C * duration_ * elastic_.speed * s.contact_ratio / *constants_.asperity_spacing);
      s.weight *= -std::expm1(-s.u) * o_.friction_coefficient->weight_of_draw(C);
      if (!(C > 0)) return nothing(contradicted);
    }
  }
  if (s.contact_ratio > 0) s.stress_pa = medium::stress_unit(elastic_.shear_modulus, s.contact_ratio) * s.stress;
  if (fixes_friction() && time_ && constants_.asperity_spacing)
    s.friction_coefficient =
        std::expm1(s.u) * *constants_.asperity_spacing / (duration_ * elastic_.speed * s.contact_ratio);
  return agrees(s) ? s : nothing(contradicted);
}

}  // namespace slipfront::event
