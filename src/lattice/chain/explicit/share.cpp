#include "lattice/chain/explicit/share.hpp"

#include <algorithm>
#include <array>
#include <string>
#include <tuple>

#include "lattice/chain/model/initial_train.hpp"
#include "math/digits.hpp"
#include "slipfront/error.hpp"
#include "slipfront/theory/train.hpp"
#include "system/team.hpp"

namespace slipfront::chain {
namespace {

/// Cuts sites [begin, end) into tiles of as many whole blocks as have `most` sites.
std::vector<std::size_t> cuts_of(const Blocks& blocks, std::size_t begin, std::size_t end, std::size_t most) {
  std::vector<std::size_t> cuts{begin};
  while (cuts.back() < end) {
    std::size_t block = blocks.of(cuts.back()) + 1;
    while (blocks.begin(block) < end && blocks.begin(block + 1) - cuts.back() <= most) ++block;
    cuts.push_back(blocks.begin(block));
  }
  return cuts;
}

EndConditions ends_of(const Problem& p, const Scheme& s) {
  const auto side = [](End end) {
    return end == End::free ? EndCondition::free : end == End::fixed ? EndCondition::fixed : EndCondition::absorbing;
  };
  EndConditions ends{side(p.boundary.left), side(p.boundary.right), 0, {}, {}};
  if (p.boundary.periodic)
    ends = {EndCondition::seam, EndCondition::seam, static_cast<double>(p.boundary.charge), {}, {}};
  const auto absorbing = [&](double stress, std::size_t site, int outward) {
    const double a = p.contact ? p.contact(p.grid.x(site)) : 1;
    const double psi0 = stress > train::smallest_stress * a ? train::psi_of_stress(stress / a) : 0;
    return AbsorbingEnd{psi0,    psi0 > 0 ? AbsorbingEnd::shocks_into(psi0) : nullptr, a, s.h, s.dt, s.eps,
                        outward, std::min<std::size_t>(24, p.grid.sites - 3)};
  };
  if (ends.left == EndCondition::absorbing) ends.absorbing_left = absorbing(p.boundary.left_stress, 0, -1);
  if (ends.right == EndCondition::absorbing)
    ends.absorbing_right = absorbing(p.boundary.right_stress, p.grid.sites - 1, 1);
  return ends;
}

bool has_halo(EndCondition side) { return side == EndCondition::joined || side == EndCondition::seam; }

[[noreturn]] void refuse_levels(std::size_t size, const std::string& allowed) {
  throw InputError({.key = "resume",
                    .value = std::to_string(size) + " sites",
                    .problem = "does not fit the scenario",
                    .allowed = allowed + " sites"});
}

}  // namespace

RankSites::RankSites(const Problem& p, const Execution& e, const Ranks& ranks, long at)
    : ranks_(ranks),
      problem_(p),
      scheme_(scheme_of(p)),
      ends_(ends_of(p, scheme_)),
      execution_(e),
      blocks_{p.grid.sites},
      first_block_(blocks_.first_of(ranks.rank(), ranks.size())),
      end_block_(blocks_.first_of(ranks.rank() + 1, ranks.size())),
      begin_(blocks_.begin(first_block_)),
      end_(blocks_.begin(end_block_)),
      forces_(p, scheme_, ranks, at, begin_, end_),
      meter_(problem_, scheme_, blocks_, first_block_, end_block_),
      level_(at) {
  check_execution();
  make_slabs();
}

void RankSites::check_execution() const {
  if (execution_.threads < 1)
    throw InputError(
        {.key = "threads", .value = std::to_string(execution_.threads), .problem = "out of range", .allowed = ">= 1"});
  check_ranks(problem_, ranks_);
}

void RankSites::make_slabs() {
  const std::size_t whole = end_block_ - first_block_;
  const auto threads = static_cast<std::size_t>(execution_.threads);
  const std::size_t cached = (execution_.tile + 2 * halo) * Sweep::usual_bytes / Sweep::bytes(forces_, meter_);
  execution_.tile = std::max(cached, 4 * halo) - 2 * halo;
  // With friction of an implicit speed, sites that move can take several times as long as those at rest, and be at one
  // side. Then each thread gets several slabs, of a tile or more.
  const std::size_t each = forces_.implicit_speed() ? 8 : 1;
  const std::size_t tiles = (end_ - begin_) / execution_.tile, most = std::clamp(tiles, threads, each * threads);
  const std::size_t count = threads == 1 ? 1 : std::clamp<std::size_t>(whole, 1, most);
  for (std::size_t i = 0; i < count; ++i) {
    const std::size_t from = blocks_.begin(first_block_ + whole * i / count);
    const std::size_t to = blocks_.begin(first_block_ + whole * (i + 1) / count);
    EndConditions s = ends_;
    if (from > 0) s.left = EndCondition::joined;
    if (to < problem_.grid.sites) s.right = EndCondition::joined;
    slabs_.emplace_back(from, to - from, s);
  }
  depth_ = std::min(halo, end_ - begin_);
  sweeps_.reserve(slabs_.size());
  for (Slab& slab : slabs_)
    sweeps_.emplace_back(slab, forces_, meter_,
                         cuts_of(blocks_, slab.begin(), slab.begin() + slab.size(), execution_.tile));
}

void RankSites::fill(const LevelsOf& source) {
  constexpr std::size_t piece = 65536;
  for (Slab& slab : slabs_)
    for (std::size_t at = 0; at < slab.size(); at += piece) {
      const std::size_t size = std::min(piece, slab.size() - at), from = slab.begin() + at;
      const Levels levels = source(from, from + size);
      const std::size_t states = levels.state.size();
      if (levels.now.size() != size || levels.before.size() != size ||
          (states != 0 && states != size * forces_.state_size()))
        refuse_levels(levels.now.size(), std::to_string(size) + " of " + std::to_string(problem_.grid.sites));
      if (problem_.phases_of_32_bits && !bounded(levels.now.data(), size, most_turns_of_phases))
        throw InputError({.key = "precision",
                          .value = "single",
                          .problem = "a displacement is " + digits(most_turns_of_phases) + " turns or more",
                          .allowed = "double"});
      std::copy_n(levels.now.data(), size, slab.now() + at);
      std::copy_n(levels.before.data(), size, slab.old() + at);
      if (states > 0) forces_.set_states(from, levels.state);
    }
  forces_.resumed();
  add_potential(-1, meter_.sums);
}

/// Adds F u at all sites to the energies supplied, for a force that does not change.
void RankSites::add_potential(double strength, std::vector<double>& energies) const {
  if (!problem_.forcing || !forces_.steady()) return;
  std::vector<double> u, S;
  for (const Slab& slab : slabs_)
    for (std::size_t b = blocks_.of(slab.begin()); b < end_block_ && blocks_.begin(b) < slab.begin() + slab.size();
         ++b) {
      const std::size_t begin = blocks_.begin(b), end = blocks_.begin(b + 1), size = end - begin;
      u.resize(size + lanes);
      S.resize(size + lanes);
      displacements(substrate_force(0), scheme_.eps, forces_.a2(static_cast<long>(begin)),
                    slab.now() + (begin - slab.begin()), u.data(), S.data(), size);
      meter_.add_potential(strength, forces_.steady_F(static_cast<long>(begin)), begin, end, u.data(), energies);
    }
}

void RankSites::exchange_with_ranks() {
  std::array<double, 2 * halo> to_left, to_right, from_left, from_right;
  Slab &first = slabs_.front(), &last = slabs_.back();
  const std::size_t rest = last.size() - halo;
  std::copy_n(first.now(), halo, to_left.begin());
  std::copy_n(first.old(), halo, to_left.begin() + halo);
  std::copy_n(last.now() + rest, halo, to_right.begin());
  std::copy_n(last.old() + rest, halo, to_right.begin() + halo);
  ranks_.exchange(to_left, to_right, from_left, from_right, problem_.boundary.periodic);
  if (has_halo(first.ends().left)) {
    std::copy_n(from_left.begin(), halo, first.now() - halo);
    std::copy_n(from_left.begin() + halo, halo, first.old() - halo);
  }
  if (has_halo(last.ends().right)) {
    std::copy_n(from_right.begin(), halo, last.now() + last.size());
    std::copy_n(from_right.begin() + halo, halo, last.old() + last.size());
  }
}

void RankSites::exchange_slab(std::size_t i) {
  Slab& slab = slabs_[i];
  const std::size_t count = slabs_.size(), most = std::min(halo, problem_.grid.sites);
  const bool alone = ranks_.size() == 1;
  if (has_halo(slab.ends().left) && (alone || i > 0)) {
    const Slab& from = slabs_[(i + count - 1) % count];
    std::copy_n(from.now() + from.size() - most, most, slab.now() - most);
    std::copy_n(from.old() + from.size() - most, most, slab.old() - most);
  }
  if (has_halo(slab.ends().right) && (alone || i + 1 < count)) {
    const Slab& from = slabs_[(i + 1) % count];
    std::copy_n(from.now(), most, slab.now() + slab.size());
    std::copy_n(from.old(), most, slab.old() + slab.size());
  }
}

void RankSites::exchange() {
  if (ranks_.size() > 1) exchange_with_ranks();
  for (std::size_t i = 0; i < slabs_.size(); ++i) exchange_slab(i);
  forces_.exchange_all(ranks_);
}

/// Calls each(i) for every slab, on all threads. `levels` is the number of levels that the slabs advance.
template <class Each>
void RankSites::for_slabs(std::size_t levels, const Each& each) {
  const bool worth = (end_ - begin_) * levels > 50000;  // waking a thread takes longer than fewer site updates
  const int threads = std::min(static_cast<int>(slabs_.size()), execution_.threads);
  for_each_on_team(slabs_.size(), worth ? threads : 1, each, 1);
}

void RankSites::advance(std::size_t count) {
  if (ranks_.size() > 1) exchange_with_ranks();
  forces_.exchange(ranks_);
  for_slabs(count, [this](std::size_t i) {
    exchange_slab(i);
    sweeps_[i].exchange_states();
  });
  for_slabs(count, [this, count](std::size_t i) { sweeps_[i].advance(count); });
  level_ += static_cast<long>(count);
  forces_.proceed(count, ranks_);
}

void RankSites::check_numbers() const {
  if (forces_.contacts().acts()) forces_.contacts().check(time());
  for (const Sweep& sweep : sweeps_) {
    const std::optional<std::size_t> site = sweep.wrong_site();
    if (!site) continue;
    throw NumericsError("t = " + digits(time()) + ": displacement of site " + std::to_string(*site) +
                        " (x = " + digits(problem_.grid.x(*site)) + ") " +
                        (problem_.phases_of_32_bits
                             ? "changes by half a turn in a step or a spacing, or is a million turns. Phases of 32 "
                               "bits cannot follow it: try chain.precision = \"double\""
                             : "is not a number"));
  }
}

/// Site j, now and at the level before.
std::pair<double, double> RankSites::site(long j) const {
  const long n = static_cast<long>(problem_.grid.sites);
  double now_shift = 0, old_shift = 0, sign = 1;
  const auto reflect = [&](long last, End kind) {
    j = 2 * last - j;
    if (kind != End::fixed) return;
    const auto [now, old] = site(last);
    sign = -1;
    now_shift = 2 * now;
    old_shift = 2 * old;
  };
  if (problem_.boundary.periodic) {
    const long around = j < 0 ? -1 : j >= n ? 1 : 0;
    now_shift = old_shift = -static_cast<double>(around * problem_.boundary.charge);
  } else if (j < 0) {
    reflect(0, problem_.boundary.left);
  } else if (j >= n) {
    reflect(n - 1, problem_.boundary.right);
  }
  std::size_t i = 0;  // sites before the first slab and after the last one are in the halos of these slabs
  while (i + 1 < slabs_.size() && j >= static_cast<long>(slabs_[i + 1].begin())) ++i;
  const long k = j - static_cast<long>(slabs_[i].begin());
  return {sign * slabs_[i].now()[k] + now_shift, sign * slabs_[i].old()[k] + old_shift};
}

void RankSites::copy_levels(long first, std::size_t size, double* before, double* now) const {
  const long end = first + static_cast<long>(size);
  const auto one_by_one = [&](long from, long to) {
    for (long j = from; j < to; ++j) std::tie(now[j - first], before[j - first]) = site(j);
  };
  one_by_one(first, std::min(end, static_cast<long>(begin_)));
  for (const Slab& slab : slabs_) {
    const auto begin = static_cast<long>(slab.begin());
    const long from = std::max(first, begin), to = std::min(end, begin + static_cast<long>(slab.size()));
    if (from >= to) continue;
    std::copy_n(slab.now() + (from - begin), to - from, now + (from - first));
    std::copy_n(slab.old() + (from - begin), to - from, before + (from - first));
  }
  one_by_one(std::max(first, static_cast<long>(end_)), end);
}

Levels RankSites::levels(std::size_t begin, std::size_t end) const {
  Levels levels;
  levels.level = level_;
  for (const Slab& slab : slabs_) {
    const std::size_t from = std::max(begin, slab.begin()), to = std::min(end, slab.begin() + slab.size());
    if (from >= to) continue;
    const std::size_t at = from - slab.begin(), size = to - from;
    levels.now.insert(levels.now.end(), slab.now() + at, slab.now() + at + size);
    levels.before.insert(levels.before.end(), slab.old() + at, slab.old() + at + size);
  }
  const std::size_t from = std::max(begin, begin_), to = std::min(end, end_);
  if (from < to) levels.state = forces_.states(from, to);
  return levels;
}

std::vector<double> RankSites::flow_sums(const std::vector<double>& mine) const {
  std::vector<double> sums = ranks_.joined(mine);
  double left = 0, right = 0;  // only one slab of one rank has each end
  for (const Slab& slab : slabs_) {
    left += slab.outflow.left;
    right += slab.outflow.right;
  }
  const std::vector<double> ends = ranks_.joined({left, right});
  left = right = 0;
  for (std::size_t i = 0; i < ends.size(); i += 2) {
    left += ends[i];
    right += ends[i + 1];
  }
  sums.insert(sums.end(), {left, right});
  return sums;
}

void RankSites::continue_flows(const std::vector<double>& sums) {
  const std::size_t each = WorkMeter::sums_of_block(problem_), all = each * blocks_.count + 2;
  if (sums.size() != all) refuse_levels(sums.size(), std::to_string(all));
  std::copy_n(sums.begin() + static_cast<std::ptrdiff_t>(each * first_block_), meter_.sums.size(), meter_.sums.begin());
  if (begin_ == 0) slabs_.front().outflow.left = sums[all - 2];
  if (end_ == problem_.grid.sites) slabs_.back().outflow.right = sums.back();
}

Flows RankSites::flows() const {
  Flows flows;
  std::vector<double> mine = meter_.sums;
  add_potential(1, mine);
  const std::vector<double> all = flow_sums(mine);
  double* const kinds[] = {&flows.supplied, &flows.dissipated, &flows.by_contacts};
  for (std::size_t i = 0; i + 2 < all.size(); ++i) *kinds[i / lanes % WorkMeter::kinds(problem_)] += all[i];
  flows.outflow = all[all.size() - 2] + all.back();
  return flows;
}

}  // namespace slipfront::chain
