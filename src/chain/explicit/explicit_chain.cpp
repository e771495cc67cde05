#include "chain/explicit/explicit_chain.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "chain/explicit/explicit_window.hpp"
#include "chain/explicit/first_levels.hpp"
#include "chain/explicit/share.hpp"
#include "chain/model/start_check.hpp"
#include "foundation/archive.hpp"
#include "slipfront/error.hpp"

namespace slipfront::chain {
namespace {

/// Pieces of levels that a caller holds whole.
LevelsOf pieces_of(const Levels& saved, std::size_t sites) {
  return [&saved, sites](std::size_t begin, std::size_t end) -> Levels {
    if (saved.now.size() != sites || saved.before.size() != sites)
      throw InputError({.key = "resume",
                        .value = std::to_string(saved.now.size()) + " sites",
                        .problem = "does not fit the scenario",
                        .allowed = std::to_string(sites) + " sites"});
    const auto part = [](const std::vector<double>& all, std::size_t from, std::size_t to) {
      const auto at = [&](std::size_t j) { return all.begin() + static_cast<std::ptrdiff_t>(j); };
      return std::vector<double>(at(from), at(to));
    };
    const std::size_t variables = saved.state.size() / sites;
    return {saved.level, part(saved.now, begin, end), part(saved.before, begin, end),
            part(saved.state, variables * begin, variables * end)};
  };
}

}  // namespace

ExplicitChain::ExplicitChain(const Problem& p, const MotionOf& start, const Execution& execution)
    : Chain(p, execution.ranks), execution_(execution) {
  StartCheck look;
  ranks().together([&] {
    check(p, ranks().share_of_machine());
    share_ = std::make_unique<Share>(p, execution, ranks(), 0);
    share_->fill([&](std::size_t begin, std::size_t end) {
      return first_levels(p, share_->scheme(), share_->forces(), start, begin, end, look);
    });
  });
  look.finish(p, ranks());
  ranks().together([&] { check_charge(p, start); });
}

ExplicitChain::ExplicitChain(const Problem& p, long level, const LevelsOf& saved, const Execution& execution)
    : Chain(p, execution.ranks), execution_(execution) {
  start_from(level, saved);
}

ExplicitChain::ExplicitChain(const Problem& p, const Motion& start, const Execution& execution)
    : ExplicitChain(p, pieces_of(start, p.grid.sites), execution) {}
ExplicitChain::ExplicitChain(const Problem& p, const Levels& saved, const Execution& execution)
    : ExplicitChain(p, saved.level, pieces_of(saved, p.grid.sites), execution) {}

ExplicitChain::~ExplicitChain() = default;
ExplicitChain::ExplicitChain(ExplicitChain&&) noexcept = default;

void ExplicitChain::start_from(long level, const LevelsOf& saved) {
  constexpr long most = no_limit / 2;  // the levels after it are numbers too
  ranks().together([&] {
    check(problem(), ranks().share_of_machine());
    if (!(level >= 0 && level <= most))
      throw InputError(
          {.key = "resume", .value = std::to_string(level), .problem = "not a level", .allowed = "0 or greater"});
    share_ = std::make_unique<Share>(problem(), execution_, ranks(), level);
    share_->fill(saved);
  });
}

double ExplicitChain::dt() const { return share_->scheme().dt; }
double ExplicitChain::time() const { return share_->time(); }
long ExplicitChain::steps() const { return share_->level(); }

void ExplicitChain::advance(long levels) {
  valid_ = false;
  while (levels > 0) {
    const long some = std::min(levels, static_cast<long>(share_->depth()));
    share_->advance(static_cast<std::size_t>(some));
    ranks().together([this] { share_->check_numbers(); });
    levels -= some;
  }
  valid_ = true;
}

bool ExplicitChain::advance_to(double time, long most) {
  advance(std::min(std::lround(time / dt()) - steps(), most));
  return reached(time);
}

void ExplicitChain::exchange() const { share_->exchange(); }
Window ExplicitChain::own_window(std::size_t begin, std::size_t end, double time) const {
  return window_of(*share_, begin, end, time);
}

Flows ExplicitChain::flows() const { return share_->flows(); }
std::vector<double> ExplicitChain::flow_sums() const { return share_->flow_sums(); }

Levels ExplicitChain::levels(std::size_t begin, std::size_t end) const {
  Levels levels = share_->levels(begin, end);
  if (ranks().size() == 1) return levels;
  levels.now = ranks().joined_at_first(levels.now);
  levels.before = ranks().joined_at_first(levels.before);
  levels.state = ranks().joined_at_first(levels.state);
  return levels;
}

Levels ExplicitChain::levels() const {
  const std::size_t sites = problem().grid.sites;
  if (ranks().size() == 1) return levels(0, sites);
  Levels all;
  all.level = steps();
  constexpr std::size_t piece = std::size_t{1} << 26;  // the largest message
  for (std::size_t begin = 0; begin < sites; begin += piece) {
    const Levels some = levels(begin, std::min(begin + piece, sites));
    all.now.insert(all.now.end(), some.now.begin(), some.now.end());
    all.before.insert(all.before.end(), some.before.begin(), some.before.end());
    all.state.insert(all.state.end(), some.state.begin(), some.state.end());
  }
  return all;
}

void ExplicitChain::archive(Archive& a) {
  Levels all;
  std::vector<double> flows;
  if (!a.reads()) {
    all = levels();
    flows = flow_sums();
  }
  const std::vector<std::string> variables = state_names(problem());
  std::string names;
  for (const std::string& name : variables) names += name + " ";
  a.same(names);
  a(flows, all.level, all.state, all.now, all.before);
  a.require(all.state.size() == variables.size() * all.now.size());
  if (!a.reads()) return;
  start_from(all.level, pieces_of(all, problem().grid.sites));
  share_->continue_flows(flows);
  valid_ = true;
}

}  // namespace slipfront::chain
