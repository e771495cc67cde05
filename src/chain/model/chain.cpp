#include "slipfront/chain/chain.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "chain/model/blocks.hpp"
#include "foundation/ranks.hpp"
#include "slipfront/error.hpp"

namespace slipfront::chain {
namespace {

/// (all) Joins the windows of all ranks, in one message.
void join(const Ranks& ranks, Window& window) {
  const std::array columns{
      &window.x, &window.u, &window.velocity, &window.stress, &window.contact_squared, &window.effective_stress};
  std::vector<double> mine;
  for (std::size_t j = 0; j < window.x.size(); ++j)
    for (const std::vector<double>* column : columns) mine.push_back((*column)[j]);
  const std::vector<double> all = ranks.joined(mine);
  for (std::size_t i = 0; i < columns.size(); ++i) {
    columns[i]->clear();
    for (std::size_t at = i; at < all.size(); at += columns.size()) columns[i]->push_back(all[at]);
  }
}

}  // namespace

Sites::Sites(const Problem& problem, const Ranks* ranks)
    : problem_(problem), ranks_(ranks == nullptr ? &Ranks::single() : ranks) {}

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
  if (ranks_->size() > 1) join(*ranks_, window);
  return window;
}

bool Chain::reached(double time) const {
  const auto step = constant_step();
  return step ? steps() >= std::lround(time / *step) : this->time() >= time;
}

}  // namespace slipfront::chain
