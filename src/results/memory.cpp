#include "results/memory.hpp"

#include <algorithm>
#include <string>

#include "foundation/machine.hpp"
#include "foundation/text/digits.hpp"
#include "inference/sampling/sampler.hpp"
#include "inference/sampling/sobol.hpp"
#include "results/columns.hpp"
#include "slipfront/error.hpp"

namespace slipfront::results {

using inference::FaultState;
using inference::most_growth;
using inference::most_samples;
using inference::Sample;
using inference::Sampling;
using inference::ShiftedSobol;

namespace {

constexpr double result_itself = 4096;  // bytes of the texts, notes and quantiles of one result, without its draws
constexpr double texts_in_file = 400;

double draws_of(const EvaluationOptions& options) {
  return static_cast<double>(options.sampling.draws * (2 * sizeof(FaultState) + sizeof(inference::ObservedValues)));
}

/// The largest number of samples of one event.
double most_of(const Sampling& sampling) {
  return static_cast<double>(std::max(sampling.samples, std::min(most_growth * sampling.samples, most_samples)));
}

}  // namespace

double memory_needed(const EvaluationOptions& options, std::size_t events, int at_once) {
  // The number of samples doubles. So does the vector that holds them, and while it grows, its old half exists too. In
  // addition there are the weights and the order of samples. All Sobol sequences stay in memory, each twice as
  // long as the one before.
  const double of_sample = 3 * sizeof(Sample) + 4 * sizeof(double);
  const double most = most_of(options.sampling);
  const double kept = most > static_cast<double>(options.sampling.samples) ? 2 : 1;
  const double sequences = kept * sizeof(double) * static_cast<double>(ShiftedSobol::dimensions);
  const double together = std::min(static_cast<double>(events), static_cast<double>(at_once));
  return most * (together * of_sample + sequences) + static_cast<double>(events) * (result_itself + draws_of(options));
}

double disk_needed(const EvaluationOptions& options, std::size_t events) {
  double numbers = 0;
  for (const NumberColumn& c : number_columns({.pulse = options.pulse, .draws = options.sampling.draws}))
    numbers += static_cast<double>(c.count);
  // The draws are also in the state from which a run resumes, and in the groups.
  return static_cast<double>(events) * (sizeof(double) * numbers + 2 * draws_of(options) + texts_in_file);
}

void require_memory(const EvaluationOptions& options, std::size_t events, int at_once, bool with_file) {
  const auto needed = [&](const EvaluationOptions& o) {
    return memory_needed(o, events, at_once) + (with_file ? 2 * disk_needed(o, events) : 0);
  };
  const double need = needed(options), have = usable_memory();
  if (need <= have) return;
  EvaluationOptions without_draws = options;
  without_draws.sampling.draws = 0;
  const bool by_draws = needed(without_draws) < need / 2;
  throw InputError({.file = "command line",
                    .key = by_draws ? "--draws" : "--samples",
                    .value = std::to_string(by_draws ? options.sampling.draws : options.sampling.samples),
                    .problem = std::to_string(events) + " events, " + std::to_string(at_once) + " at a time, need " +
                               digits(need / 1e9, 3) + " GB of memory, this process may have " + digits(have / 1e9, 3) +
                               " GB",
                    .allowed = by_draws ? "fewer draws or events" : "fewer samples or threads"});
}

}  // namespace slipfront::results
