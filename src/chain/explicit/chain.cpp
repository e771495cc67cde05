#include "slipfront/chain/chain.hpp"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "chain/explicit/parts.hpp"
#include "chain/explicit/start.hpp"
#include "slipfront/error.hpp"

namespace slipfront::chain {
namespace {

std::vector<double> part(const std::vector<double>& all, std::size_t begin, std::size_t end) {
  const auto at = [&](std::size_t j) { return all.begin() + static_cast<std::ptrdiff_t>(j); };
  return {at(begin), at(end)};
}

void refuse_size(const char* what, std::size_t size, std::size_t sites, const char* with) {
  throw InputError({.key = what,
                    .value = std::to_string(size) + " sites",
                    .problem = std::string("does not fit the ") + with,
                    .allowed = std::to_string(sites) + " sites"});
}

/// Pieces of what is held whole.
MotionOf pieces(const Motion& start, std::size_t sites) {
  return [&start, sites](std::size_t begin, std::size_t end) -> Motion {
    if (start.u.size() != sites || (!start.velocity.empty() && start.velocity.size() != sites))
      refuse_size("initial motion", start.u.size(), sites, "grid");
    if (start.velocity.empty()) return {part(start.u, begin, end), {}};
    return {part(start.u, begin, end), part(start.velocity, begin, end)};
  };
}
LevelsOf pieces(const Levels& saved, std::size_t sites) {
  return [&saved, sites](std::size_t begin, std::size_t end) -> Levels {
    if (saved.now.size() != sites || saved.before.size() != sites)
      refuse_size("resume", saved.now.size(), sites, "scenario");
    const std::size_t variables = saved.memory.size() / sites;
    return {saved.level, part(saved.now, begin, end), part(saved.before, begin, end),
            part(saved.memory, variables * begin, variables * end)};
  };
}

}  // namespace

Chain::Chain(const Problem& problem, const MotionOf& start, const Execution& execution) {
  const Ranks& ranks = Parts::ranks_of(execution);
  StartCheck look;
  ranks.together([&] {
    check(problem, ranks.share_of_machine());
    parts_ = std::make_unique<Parts>(problem, execution, 0);
    parts_->fill([&](std::size_t begin, std::size_t end) {
      return first_levels(problem, parts_->scheme, parts_->forces, start, begin, end, look);
    });
  });
  look.finish(problem, ranks);
  ranks.together([&] {
    check_charge(problem, start);
    if (problem.implicit)
      parts_->implicit = std::make_unique<ImplicitSteps>(problem, start(0, problem.grid.sites), execution.threads);
  });
}

Chain::Chain(const Problem& problem, long level, const LevelsOf& saved, const Execution& execution) {
  const Ranks& ranks = Parts::ranks_of(execution);
  ranks.together([&] {
    check(problem, ranks.share_of_machine());
    if (level < 0)
      throw InputError(
          {.key = "resume", .value = std::to_string(level), .problem = "not a level", .allowed = "0 or greater"});
    parts_ = std::make_unique<Parts>(problem, execution, level);
    parts_->fill(saved);
  });
}

Chain::Chain(const Problem& problem, const Motion& start, const Execution& execution)
    : Chain(problem, pieces(start, problem.grid.sites), execution) {}
Chain::Chain(const Problem& problem, const Levels& saved, const Execution& execution)
    : Chain(problem, saved.level, pieces(saved, problem.grid.sites), execution) {}

bool Chain::implicit() const { return parts_->implicit != nullptr; }
bool Chain::proceed(double until, long most) {
  parts_->implicit->advance(until, most);
  return time() >= until;
}
std::vector<double> Chain::implicit_state() const { return parts_->implicit->saved(); }
void Chain::continue_implicit(const std::vector<double>& state) { parts_->implicit->resume(state); }
std::vector<Event> Chain::events() const {
  return parts_->implicit ? parts_->implicit->events() : std::vector<Event>{};
}

Chain::~Chain() = default;
Chain::Chain(Chain&&) noexcept = default;
Chain& Chain::operator=(Chain&&) noexcept = default;

void Chain::advance(long levels) {
  while (levels > 0) {
    const long some = std::min(levels, static_cast<long>(parts_->depth));
    parts_->advance(static_cast<std::size_t>(some));
    parts_->ranks.together([&] { parts_->check_numbers(); });
    levels -= some;
  }
}

bool Chain::advance_to(double time, const std::function<bool()>& interrupted) {
  const long target = std::lround(time / dt());
  while (level() < target) {
    advance(std::min<long>(target - level(), halo));
    if (interrupted && parts_->ranks.any(interrupted())) break;
  }
  return level() >= target;
}

std::vector<double> Chain::flow_sums() const {
  std::vector<double> sums = parts_->ranks.joined(parts_->meter.sums);
  double left = 0, right = 0;  // each of one slab of one rank
  for (const Slab& slab : parts_->slabs) {
    left += slab.outflow.left;
    right += slab.outflow.right;
  }
  const std::vector<double> ends = parts_->ranks.joined({left, right});
  left = right = 0;
  for (std::size_t i = 0; i < ends.size(); i += 2) {
    left += ends[i];
    right += ends[i + 1];
  }
  sums.insert(sums.end(), {left, right});
  return sums;
}

void Chain::continue_flows(const std::vector<double>& sums) {
  std::vector<double>& mine = parts_->meter.sums;
  const std::size_t kinds = WorkMeter::kinds(problem());
  if (sums.size() != kinds * parts_->blocks.count + 2)
    refuse_size("resume", sums.size(), kinds * parts_->blocks.count + 2, "scenario");
  std::copy_n(sums.begin() + static_cast<std::ptrdiff_t>(kinds * parts_->first_block), mine.size(), mine.begin());
  if (parts_->begin == 0) parts_->slabs.front().outflow.left = sums[sums.size() - 2];
  if (parts_->end == problem().grid.sites) parts_->slabs.back().outflow.right = sums.back();
}

Chain::Flows Chain::flows() const {
  Flows flows;
  if (const auto& steps = parts_->implicit) return {steps->supplied(), steps->dissipated(), 0, steps->by_contacts()};
  const std::vector<double> all = flow_sums();
  const std::size_t kinds = WorkMeter::kinds(problem());
  for (std::size_t i = 0; i + 2 < all.size(); i += kinds) {
    flows.supplied += all[i];
    flows.dissipated += all[i + 1];
    if (kinds > 2) flows.by_contacts += all[i + 2];
  }
  flows.outflow = all[all.size() - 2] + all.back();
  return flows;
}

bool Chain::meters_friction() const { return implicit() || parts_->level_by_level; }

const Problem& Chain::problem() const { return parts_->problem; }
long Chain::level() const { return implicit() ? parts_->implicit->steps() : parts_->level; }
double Chain::dt() const { return parts_->scheme.dt; }
double Chain::time() const { return implicit() ? parts_->implicit->time() : static_cast<double>(level()) * dt(); }

Levels Chain::levels(std::size_t begin, std::size_t end) const {
  Levels levels;
  levels.level = level();
  for (const Slab& slab : parts_->slabs) {
    const std::size_t from = std::max(begin, slab.begin()), to = std::min(end, slab.begin() + slab.size());
    if (from >= to) continue;
    const std::size_t at = from - slab.begin(), size = to - from;
    levels.now.insert(levels.now.end(), slab.now() + at, slab.now() + at + size);
    levels.before.insert(levels.before.end(), slab.old() + at, slab.old() + at + size);
  }
  if (parts_->ranks.size() == 1) {
    levels.memory = parts_->forces.memories(begin, end);
    return levels;
  }
  levels.now = parts_->ranks.joined_at_first(levels.now);
  levels.before = parts_->ranks.joined_at_first(levels.before);
  return levels;
}

Levels Chain::levels() const {
  const std::size_t sites = problem().grid.sites;
  if (parts_->ranks.size() == 1) return levels(0, sites);
  Levels all;
  all.level = level();
  constexpr std::size_t piece = std::size_t{1} << 26;  // what a message can carry
  for (std::size_t begin = 0; begin < sites; begin += piece) {
    const Levels some = levels(begin, std::min(begin + piece, sites));
    all.now.insert(all.now.end(), some.now.begin(), some.now.end());
    all.before.insert(all.before.end(), some.before.begin(), some.before.end());
  }
  return all;
}

double Chain::contact_squared(std::size_t site) const {
  if (implicit()) return parts_->implicit->contact_squared(site);
  const double* a2 = parts_->forces.a2(static_cast<long>(site));
  return a2 == nullptr ? 1 : *a2;
}
double Chain::forcing(std::size_t site) const {
  if (implicit()) return parts_->implicit->forcing(site);
  return parts_->forces.now(static_cast<long>(site));
}
double Chain::effective_stress(std::size_t site) const {
  if (implicit()) return parts_->implicit->effective_stress(site);
  const ContactField& contacts = parts_->forces.contacts();
  return contacts.acts() ? *contacts.share(static_cast<long>(site)) : 1;
}
double Chain::friction(std::size_t site, double velocity) const {
  if (implicit()) return parts_->implicit->friction(site, velocity);
  return parts_->forces.friction(static_cast<long>(site), velocity);
}

}  // namespace slipfront::chain
