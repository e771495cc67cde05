#include "results/serialize.hpp"

#include "foundation/archive.hpp"

namespace slipfront::results {
namespace {

void archive_quantiles(Archive& a, inference::QuantileQuantities& of) {
  for (const inference::Quantity& q : inference::quantities()) a(of.*q.quantiles);
}

void archive_posterior(Archive& a, inference::Posterior& p) {
  archive_quantiles(a, p);
  a(p.friction_identified, p.contact_ratio_prior_share, p.damping_number_prior_share, p.trade_off);
  a.each(p.tension, [&](inference::Tension& t) {
    a(t.observation, t.sigmas);
    archive_quantiles(a, t.without);
  });
  a.each(p.predictions, [&](inference::Prediction& one) { a(one.observation, one.below); });
  a(p.contradicted, p.draws, p.prior_draws, p.repeated, p.notes);
  a(p.suffices, p.effective_samples, p.pareto_k, p.samples, p.seed);
}

/// The members that take time to compute.
template <class Result>
void archive_result(Archive& a, Result& result) {
  a.maybe(result.posterior, [&](inference::Posterior& p) { archive_posterior(a, p); });
  a(result.pulse, result.error);
}

}  // namespace

std::string serialize(std::span<const EventResult> results) {
  std::string bytes;
  Archive a = Archive::to(bytes);
  for (const EventResult& r : results) archive_result(a, const_cast<EventResult&>(r));  // writing changes no member
  return bytes;
}

std::vector<SavedResult> deserialize(std::string_view saved) {
  std::vector<SavedResult> all;
  for (Archive a = Archive::from(saved); !a.at_end();) archive_result(a, all.emplace_back());
  return all;
}

}  // namespace slipfront::results
