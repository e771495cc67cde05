#include "slipfront/chain/chain.hpp"

#include <algorithm>
#include <cmath>

#include "chain/model/blocks.hpp"
#include "foundation/ranks.hpp"
#include "slipfront/error.hpp"

namespace slipfront::chain {
namespace {

const Ranks* one_process() {
  static const Ranks ranks;
  return &ranks;
}

}  // namespace

Sites::Sites(const Problem& problem, const Ranks* ranks)
    : problem_(problem), ranks_(ranks == nullptr ? one_process() : ranks) {}

Window Sites::window(std::size_t begin, std::size_t end, double time) const {
  const auto step = constant_step();
  const double most = step ? 1.0001 * *step : 1e-9 * (1 + time);
  if (!(begin < end) || end > problem_.grid.sites || !(std::fabs(time - this->time()) <= most))
    throw InputError(
        {.key = "window", .problem = "outside the chain or its present step", .allowed = "sites of the chain, now"});
  exchange();
  const Blocks blocks{problem_.grid.sites};
  const std::size_t from = std::max(begin, blocks.begin(blocks.first_of(ranks_->rank(), ranks_->size())));
  const std::size_t to = std::min(end, blocks.begin(blocks.first_of(ranks_->rank() + 1, ranks_->size())));
  Window window;
  if (from < to) window = own_window(from, to, time);
  window.begin = begin;
  if (ranks_->size() > 1)
    for (std::vector<double>* values : {&window.x, &window.u, &window.velocity, &window.stress})
      *values = ranks_->joined(*values);
  return window;
}

bool Chain::reached(double time) const {
  const auto step = constant_step();
  return step ? steps() >= std::lround(time / *step) : this->time() >= time;
}

}  // namespace slipfront::chain
