#include <algorithm>
#include <string>

#include "../digits.hpp"
#include "sampler.hpp"
#include "slipfront/error.hpp"
#include "slipfront/event/columns.hpp"
#include "slipfront/event/evaluate.hpp"
#include "slipfront/machine.hpp"
#include "sobol.hpp"

namespace slipfront::event {
namespace {

constexpr double result_itself = 4096;  // bytes of one result without its draws: texts, notes, quantiles
constexpr double texts_in_file = 400;

double draws_of(const Plan& plan) { return static_cast<double>(plan.sampling.draws * sizeof(FaultState)); }

/// Samples of one event, as many as they may become.
double most_of(const Sampling& sampling) {
  return static_cast<double>(std::max(sampling.samples, std::min(most_growth * sampling.samples, most_samples)));
}

}  // namespace

double memory_needed(const Plan& plan, std::size_t events, int at_once) {
  // Samples double: the vector that holds them does as well, and while it grows its old half is there too. Beside it
  // their weights and their order. The sequences that they are drawn from stay, each twice as long as the one before.
  const double of_sample = 3 * sizeof(Sample) + 4 * sizeof(double);
  const double most = most_of(plan.sampling);
  const double kept = most > static_cast<double>(plan.sampling.samples) ? 2 : 1;
  const double sequences = kept * sizeof(double) * static_cast<double>(ShiftedSobol::dimensions);
  const double together = std::min(static_cast<double>(events), static_cast<double>(at_once));
  return most * (together * of_sample + sequences) + static_cast<double>(events) * (result_itself + draws_of(plan));
}

double disk_needed(const Plan& plan, std::size_t events) {
  double numbers = 0;
  for (const NumberColumn& c : number_columns({.pulse = plan.pulse, .draws = plan.sampling.draws}))
    numbers += static_cast<double>(c.count);
  return static_cast<double>(events) * (sizeof(double) * numbers + texts_in_file);
}

void require_memory(const Plan& plan, std::size_t events, int at_once, bool with_file) {
  const double need = memory_needed(plan, events, at_once) + (with_file ? 2 * disk_needed(plan, events) : 0);
  const double have = usable_memory();
  if (need <= have) return;
  const bool by_draws = draws_of(plan) * static_cast<double>(events) > need / 4;
  throw InputError({.file = "command line",
                    .key = by_draws ? "--draws" : "--samples",
                    .value = std::to_string(by_draws ? plan.sampling.draws : plan.sampling.samples),
                    .problem = std::to_string(events) + " events, " + std::to_string(at_once) + " at a time, need " +
                               digits(need / 1e9, 3) + " GB of memory, this process may have " + digits(have / 1e9, 3) +
                               " GB",
                    .allowed = by_draws ? "fewer draws or events" : "fewer samples or threads"});
}

}  // namespace slipfront::event
