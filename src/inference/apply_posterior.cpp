#include "slipfront/inference/posterior.hpp"

namespace slipfront::inference {
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
