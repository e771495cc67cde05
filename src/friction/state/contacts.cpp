#include "friction/state/contacts.hpp"

#include <algorithm>
#include <cmath>

#include "math/simd/elementary.hpp"
#include "math/simd/vector_code.hpp"

namespace slipfront::friction {
namespace {

constexpr double short_step = 1.0 / 16;  ///< limit of the slip over D_c in age_little

/// Advances theta, to 1e-17, at positions that slip less than short_step. The others stay unchanged. Returns whether
/// there are no others.
SLIPFRONT_CLONES bool age_little(std::size_t size, const double* velocity, double per_D, double time, double* theta) {
  constexpr double c[] = {1.0,        -1.0 / 2,   1.0 / 6,      -1.0 / 24,    1.0 / 120,
                          -1.0 / 720, 1.0 / 5040, -1.0 / 40320, 1.0 / 362880, -1.0 / 3628800};
  std::size_t others = 0;
  SLIPFRONT_INDEPENDENT
  for (std::size_t j = 0; j < size; ++j) {
    const double p = std::fabs(velocity[j]) * per_D;
    const bool little = p < short_step;
    theta[j] += little ? polynomial(c, little ? p : 0.0) * (time - p * theta[j]) : 0.0;
    others += little ? 0u : 1u;
  }
  return others == 0;
}

SLIPFRONT_CLONES void age_much(std::size_t size, const double* velocity, double per_D, double time, double* theta) {
  SLIPFRONT_INDEPENDENT
  for (std::size_t j = 0; j < size; ++j) {
    const double p = std::fabs(velocity[j]) * per_D;
    const double decay = exp_branch_free(-at_most(p, 650.0));
    theta[j] = p < short_step ? theta[j] : theta[j] * decay + time * ((1 - decay) / p);
  }
}

void advance_by_ageing(double D, std::size_t size, const double* velocity, double time, double* theta) {
  const double per_D = time / D;
  if (!age_little(size, velocity, per_D, time, theta)) age_much(size, velocity, per_D, time, theta);
}

SLIPFRONT_CLONES void advance_by_slip(double D, std::size_t size, const double* mean, const double* typical,
                                      double time, double* theta) {
  const double per_D = 1 / D;
  SLIPFRONT_INDEPENDENT
  for (std::size_t j = 0; j < size; ++j) {
    const double p = std::fabs(mean[j]) * time * per_D, x = std::fabs(typical[j]) * theta[j] * per_D;
    const double change = log_branch_free(at_least(x, 1e-300)) * expm1_branch_free(-at_most(p, 650.0));
    theta[j] *= p > 0 && x > 0 ? exp_branch_free(at_most(at_least(change, -650.0), 650.0)) : 1.0;
  }
}

}  // namespace

void ContactAge::advance(const Slip& slip, double time, std::span<double> theta) const {
  const double speed = std::fabs(slip.mean), typical = std::fabs(slip.typical), passed = speed * time / D_;
  if (kind_ == Kind::slip) {
    if (speed > 0 && typical > 0)
      theta[0] *= std::exp(std::log(typical * theta[0] / D_) * std::expm1(-speed * time / D_));
    return;
  }
  const double gained = passed > 1e-12 ? -std::expm1(-passed) / passed : 1 - passed / 2;
  theta[0] = theta[0] * std::exp(-passed) + time * gained;
}

void ContactAge::advance_all(std::size_t size, const Slips& slips, double time, EvolvingStates states) const {
  change_in_parts(size, states, [&](std::size_t begin, std::size_t some, double* theta) {
    if (kind_ == Kind::slip)
      advance_by_slip(D_, some, slips.mean + begin, slips.typical + begin, time, theta);
    else
      advance_by_ageing(D_, some, slips.mean + begin, time, theta);
  });
}

namespace {

constexpr double tiny = 1e-300;  ///< theta below it counts as it

/// p - p_0 after a time is decay times that before, and gain ln(theta / theta_before).
struct PressureRule {
  double decay = 1, gain;
  PressureRule(const Contacts& c, double time) : gain(c.dilatancy) {
    const double x = c.drainage > 0 ? time / c.drainage : 0;
    if (!(x > 0)) return;
    decay = std::exp(-x);
    gain *= -std::expm1(-x) / x;
  }
};

/// The excess pressure of a position, and what multiplies its a^2.
struct ContactAfter {
  double excess, strength;
};
SLIPFRONT_INLINE ContactAfter contact_after(double decay, double gain, double ageing, double per_age, double ambient,
                                            double theta_before, double theta, double excess) {
  const double before = theta_before > tiny ? theta_before : tiny, now = theta > tiny ? theta : tiny;
  const double q = decay * excess + gain * log_branch_free(now / before), share = 1 - (ambient + q);
  return {q, share * share * (1 + ageing * log_branch_free(1 + now * per_age))};
}

double per_age(const Contacts& contacts) { return contacts.ageing > 0 ? 1 / contacts.age : 0; }

SLIPFRONT_CLONES void advance_positions(const Contacts& contacts, const PressureRule& rule, std::size_t size,
                                        const double* theta_before, const double* theta, double* excess,
                                        double* strength) {
  const PressureRule r = rule;
  const double ageing = contacts.ageing, age_share = per_age(contacts), ambient = contacts.ambient;
  SLIPFRONT_INDEPENDENT
  for (std::size_t j = 0; j < size; ++j) {
    const ContactAfter after =
        contact_after(r.decay, r.gain, ageing, age_share, ambient, theta_before[j], theta[j], excess[j]);
    excess[j] = after.excess;
    strength[j] = after.strength;
  }
}

SLIPFRONT_CLONES void find_rules(std::size_t size, double time, const double* per_drainage, const double* dilatancy,
                                 double* decay, double* gain) {
  SLIPFRONT_INDEPENDENT
  for (std::size_t j = 0; j < size; ++j) {
    const double x = at_most(time * per_drainage[j], 650.0), lost = -expm1_branch_free(-x);
    decay[j] = 1 - lost;
    gain[j] = dilatancy[j] * (x > 0 ? lost / x : 1.0);
  }
}

SLIPFRONT_CLONES void advance_where_they_vary(std::size_t size, const double* decay, const double* gain,
                                              const double* ageing, const double* per_age, const double* ambient,
                                              const double* theta_before, const double* theta, double* excess,
                                              double* strength) {
  SLIPFRONT_INDEPENDENT
  for (std::size_t j = 0; j < size; ++j) {
    const ContactAfter after =
        contact_after(decay[j], gain[j], ageing[j], per_age[j], ambient[j], theta_before[j], theta[j], excess[j]);
    excess[j] = after.excess;
    strength[j] = after.strength;
  }
}

}  // namespace

double Contacts::strength(double theta, double excess) const {
  return share(excess) * share(excess) * (ageing > 0 ? 1 + ageing * std::log1p(theta / age) : 1);
}

double Contacts::excess_after(double time, double excess, double theta_before, double theta) const {
  const PressureRule rule(*this, time);
  return rule.decay * excess + rule.gain * std::log(std::fmax(theta, tiny) / std::fmax(theta_before, tiny));
}

void Contacts::advance(std::size_t size, double time, const double* theta_before, const double* theta, double* excess,
                       double* strength) const {
  advance_positions(*this, PressureRule(*this, time), size, theta_before, theta, excess, strength);
}

void VaryingContacts::add(const Contacts& contacts) {
  ageing_.push_back(contacts.ageing);
  per_age_.push_back(per_age(contacts));
  dilatancy_.push_back(contacts.dilatancy);
  per_drainage_.push_back(contacts.drainage > 0 ? 1 / contacts.drainage : 0);
  ambient_.push_back(contacts.ambient);
}

void VaryingContacts::advance(std::size_t first, std::size_t size, double time, const double* theta_before,
                              const double* theta, double* excess, double* strength) const {
  double decay[part_size], gain[part_size];
  in_parts(size, [&](std::size_t begin, std::size_t some) {
    const std::size_t at = first + begin;
    find_rules(some, time, &per_drainage_[at], &dilatancy_[at], decay, gain);
    advance_where_they_vary(some, decay, gain, &ageing_[at], &per_age_[at], &ambient_[at], theta_before + begin,
                            theta + begin, excess + begin, strength + begin);
  });
}

}  // namespace slipfront::friction
