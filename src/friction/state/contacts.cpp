#include "friction/state/contacts.hpp"

#include <cmath>

#include "foundation/simd/elementary.hpp"
#include "foundation/simd/vector_code.hpp"

namespace slipfront::friction {
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

SLIPFRONT_CLONES void advance_positions(const Contacts& contacts, const PressureRule& rule, std::size_t size,
                                        const double* theta_before, const double* theta, double* excess,
                                        double* strength) {
  const PressureRule r = rule;
  const double beta = contacts.ageing, per_age = beta > 0 ? 1 / contacts.age : 0, ambient = contacts.ambient;
  SLIPFRONT_INDEPENDENT
  for (std::size_t j = 0; j < size; ++j) {
    const double before = theta_before[j] > tiny ? theta_before[j] : tiny, now = theta[j] > tiny ? theta[j] : tiny;
    const double q = r.decay * excess[j] + r.gain * log_branch_free(now / before), share = 1 - (ambient + q);
    excess[j] = q;
    strength[j] = share * share * (1 + beta * log_branch_free(1 + now * per_age));
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

}  // namespace slipfront::friction
