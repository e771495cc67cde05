#include "chain/explicit/parts.hpp"

#include <algorithm>
#include <array>
#include <string>

#include "foundation/text/digits.hpp"
#include "slipfront/error.hpp"
#include "slipfront/train/train.hpp"

namespace slipfront::chain {
namespace {

/// A chain with viscous friction alone advances level by level and meters its work up to so many sites. That costs
/// about a nanosecond a site and level more; 200 samples (Run::sample) cost as much as 13 000 such levels.
constexpr std::size_t metered_sites = 10000;

/// Cuts blocks [begin, end) of sites into pieces that stay in the innermost cache with the forces on them and their
/// works: as many whole blocks as fit, or some sites of one that is longer.
std::vector<std::size_t> pieces_of(const Blocks& blocks, std::size_t begin, std::size_t end) {
  constexpr std::size_t piece = WorkMeter::piece;
  std::vector<std::size_t> cuts{begin};
  while (cuts.back() < end) {
    const std::size_t from = cuts.back();
    std::size_t block = blocks.of(from) + 1;
    if (blocks.begin(block) - from > 2 * piece) {
      cuts.push_back(from + piece);
      continue;
    }
    while (blocks.begin(block) < end && blocks.begin(block + 1) - from <= piece) ++block;
    cuts.push_back(blocks.begin(block));
  }
  return cuts;
}

Sides sides_of(const Problem& p, const Scheme& s) {
  const auto side = [](End end) {
    return end == End::free ? Side::free : end == End::fixed ? Side::fixed : Side::absorbing;
  };
  Sides sides{side(p.boundary.left), side(p.boundary.right), 0, {}, {}};
  if (p.boundary.periodic) sides = {Side::seam, Side::seam, static_cast<double>(p.boundary.charge), {}, {}};
  const auto absorbing = [&](double stress, std::size_t site, int outward) {
    const double a = p.contact ? p.contact(p.grid.x(site)) : 1;
    const double psi0 = stress > train::smallest_stress * a ? train::psi_of_stress(stress / a) : 0;
    return AbsorbingEnd{psi0,    psi0 > 0 ? AbsorbingEnd::shocks_into(psi0) : nullptr, a, s.h, s.dt, s.eps,
                        outward, std::min<std::size_t>(24, p.grid.sites - 3)};
  };
  if (sides.left == Side::absorbing) sides.beyond_left = absorbing(p.boundary.left_stress, 0, -1);
  if (sides.right == Side::absorbing) sides.beyond_right = absorbing(p.boundary.right_stress, p.grid.sites - 1, 1);
  return sides;
}

}  // namespace

const Ranks& Chain::Parts::ranks_of(const Execution& e) {
  static const Ranks alone;
  return e.ranks == nullptr ? alone : *e.ranks;
}

Chain::Parts::Parts(const Problem& p, const Execution& e, long at)
    : ranks(ranks_of(e)),
      problem(p),
      scheme(scheme_of(p)),
      sides(sides_of(p, scheme)),
      execution(e),
      blocks{p.grid.sites},
      first_block(blocks.first_of(ranks.rank(), ranks.size())),
      end_block(blocks.first_of(ranks.rank() + 1, ranks.size())),
      begin(blocks.begin(first_block)),
      end(blocks.begin(end_block)),
      forces(p, scheme, at, begin, end),
      level_by_level(!forces.none() || (p.friction.acts() && p.grid.sites <= metered_sites)),
      meter(problem, level_by_level && (p.forcing || p.friction.acts()), scheme, blocks, first_block, end_block),
      level(at) {
  if (e.threads < 1)
    throw InputError(
        {.key = "threads", .value = std::to_string(e.threads), .problem = "out of range", .allowed = ">= 1"});
  if (ranks.size() > 1 && p.friction.variables() > 0)
    throw InputError({.key = "ranks",
                      .value = std::to_string(ranks.size()),
                      .problem = "friction.law = \"" + std::string(p.friction.name()) + "\" has variables at each site",
                      .allowed = "1 rank, with as many threads as wanted"});
  if (ranks.size() > 1 && p.implicit)
    throw InputError({.key = "ranks",
                      .value = std::to_string(ranks.size()),
                      .problem = "[loading] and implicit steps are for one process",
                      .allowed = "1 rank, with as many threads as wanted"});
  if (static_cast<std::size_t>(ranks.size()) > blocks.count)
    throw InputError({.key = "ranks",
                      .value = std::to_string(ranks.size()),
                      .problem = "too many for " + std::to_string(p.grid.sites) + " sites",
                      .allowed = "1 to " + std::to_string(blocks.count)});
  const std::size_t n = end - begin, whole = end_block - first_block;
  const std::size_t count = std::clamp<std::size_t>(whole, 1, static_cast<std::size_t>(e.threads));
  execution.tile = std::max(e.tile / lanes * lanes, 2 * halo);
  for (std::size_t i = 0; i < count; ++i) {
    const std::size_t from = blocks.begin(first_block + whole * i / count);
    const std::size_t to = blocks.begin(first_block + whole * (i + 1) / count);
    Sides s = sides;
    if (from > 0) s.left = Side::joined;
    if (to < p.grid.sites) s.right = Side::joined;
    slabs.emplace_back(from, to - from, s);
  }
  depth = level_by_level ? 1 : std::min(halo, n);
  if (!level_by_level) return;
  for (const Slab& slab : slabs) {
    constexpr std::size_t room = 2 * WorkMeter::piece + 4 * lanes;  // of the longest piece, and beside it
    by_level.push_back({pieces_of(blocks, slab.begin(), slab.begin() + slab.size()), Aligned(room), Aligned(room),
                        WorkMeter::Room(meter.active() ? room : 0)});
  }
}

void Chain::Parts::fill(const std::function<Levels(std::size_t, std::size_t)>& source) {
  constexpr std::size_t piece = 65536;
  for (Slab& slab : slabs)
    for (std::size_t at = 0; at < slab.size(); at += piece) {
      const std::size_t size = std::min(piece, slab.size() - at), from = slab.begin() + at;
      const Levels levels = source(from, from + size);
      const std::size_t memory = levels.memory.size(), all = size * forces.remembered();
      if (levels.now.size() != size || levels.before.size() != size || (memory != 0 && memory != all))
        throw InputError({.key = "resume",
                          .value = std::to_string(levels.now.size()) + " sites",
                          .problem = "does not fit the scenario",
                          .allowed = std::to_string(size) + " of " + std::to_string(problem.grid.sites) + " sites"});
      std::copy_n(levels.now.data(), size, slab.now() + at);
      std::copy_n(levels.before.data(), size, slab.old() + at);
      if (!levels.memory.empty()) forces.set_memories(from, levels.memory);
      meter.start(forces, from, size, slab.now() + at);
    }
  forces.resumed();
}

void Chain::Parts::exchange_with_ranks() {
  std::array<double, 2 * halo> to_left, to_right, from_left, from_right;
  Slab &first = slabs.front(), &last = slabs.back();
  const std::size_t rest = last.size() - halo;
  std::copy_n(first.now(), halo, to_left.begin());
  std::copy_n(first.old(), halo, to_left.begin() + halo);
  std::copy_n(last.now() + rest, halo, to_right.begin());
  std::copy_n(last.old() + rest, halo, to_right.begin() + halo);
  ranks.exchange(to_left, to_right, from_left, from_right, problem.boundary.periodic);
  if (first.sides().left == Side::joined || first.sides().left == Side::seam) {
    std::copy_n(from_left.begin(), halo, first.now() - halo);
    std::copy_n(from_left.begin() + halo, halo, first.old() - halo);
  }
  if (last.sides().right == Side::joined || last.sides().right == Side::seam) {
    std::copy_n(from_right.begin(), halo, last.now() + last.size());
    std::copy_n(from_right.begin() + halo, halo, last.old() + last.size());
  }
}

void Chain::Parts::exchange_slab(std::size_t i) {
  Slab& slab = slabs[i];
  const std::size_t count = slabs.size(), most = std::min(halo, problem.grid.sites);
  const bool alone = ranks.size() == 1;
  if ((slab.sides().left == Side::joined || slab.sides().left == Side::seam) && (alone || i > 0)) {
    const Slab& from = slabs[(i + count - 1) % count];
    std::copy_n(from.now() + from.size() - most, most, slab.now() - most);
    std::copy_n(from.old() + from.size() - most, most, slab.old() - most);
  }
  if ((slab.sides().right == Side::joined || slab.sides().right == Side::seam) && (alone || i + 1 < count)) {
    const Slab& from = slabs[(i + 1) % count];
    std::copy_n(from.now(), most, slab.now() + slab.size());
    std::copy_n(from.old(), most, slab.old() + slab.size());
  }
}

void Chain::Parts::exchange() {
  if (ranks.size() > 1) exchange_with_ranks();
  for (std::size_t i = 0; i < slabs.size(); ++i) exchange_slab(i);
}

void Chain::Parts::advance_slab(std::size_t i, std::size_t count) {
  if (level_by_level)
    advance_by_one_level(i);
  else
    slabs[i].advance(scheme.rule, count, execution.tile);
}

void Chain::Parts::advance_by_one_level(std::size_t i) {
  Slab& slab = slabs[i];
  ByLevel& room = by_level[i];
  double *const next = room.next.data() + lanes, *const y = room.y.data() + lanes;
  for (std::size_t piece = 0; piece + 1 < room.cuts.size(); ++piece) {
    const std::size_t first = room.cuts[piece], size = room.cuts[piece + 1] - first, at = first - slab.begin();
    Sides here = slab.sides();
    if (piece > 0) here.left = Side::joined;
    if (piece + 2 < room.cuts.size()) here.right = Side::joined;
    const double *now = slab.now() + at, *before = slab.old() + at;
    forces.level(here, static_cast<long>(first), size, before, now, next, y, slab.outflow,
                 meter.active() ? room.work.friction.data() : nullptr);
    // Contacts that change are those of the next level in its displacements; friction has acted.
    const bool changes = forces.contacts().acts();
    if (changes) forces.age(static_cast<long>(first), size, now, next);
    if (meter.active()) meter.add(forces, first, first + size, before, now, next, room.work);
    if (!changes) forces.age(static_cast<long>(first), size, now, next);
    std::copy_n(next, size, slab.old() + at);
  }
  slab.swap();
}

void Chain::Parts::advance(std::size_t count) {
  // Fewer site updates than this take less time than it takes to wake a thread.
  const bool worth = slabs.size() > 1 && (end - begin) * count > 50000;
  const auto for_slabs = [&](const auto& each) {
    const int number = static_cast<int>(slabs.size());
    if (!worth) {
      for (int i = 0; i < number; ++i) each(static_cast<std::size_t>(i));
      return;
    }
    std::vector<std::exception_ptr> exceptions(slabs.size());  // by friction whose curve the user gave
#ifdef _OPENMP
#pragma omp parallel for num_threads(number) schedule(static, 1)
#endif
    for (int i = 0; i < number; ++i) {
      try {
        each(static_cast<std::size_t>(i));
      } catch (...) {
        exceptions[static_cast<std::size_t>(i)] = std::current_exception();
      }
    }
    for (const std::exception_ptr& e : exceptions)
      if (e) std::rethrow_exception(e);
  };
  if (ranks.size() > 1) exchange_with_ranks();
  for_slabs([&](std::size_t i) { exchange_slab(i); });
  for_slabs([&](std::size_t i) { advance_slab(i, count); });
  level += static_cast<long>(count);
  if (!forces.none()) forces.proceed();
}

void Chain::Parts::check_numbers() const {
  if (forces.contacts().acts()) forces.contacts().check(static_cast<double>(level) * scheme.dt);
  for (const Slab& slab : slabs) {
    if (bounded(slab.now(), slab.size())) continue;
    std::size_t j = 0;
    while (bounded(slab.now() + j, 1)) ++j;
    const std::size_t site = slab.begin() + j;
    throw NumericsError("t = " + digits(static_cast<double>(level) * scheme.dt) + ": displacement of site " +
                        std::to_string(site) + " (x = " + digits(problem.grid.x(site)) + ") is not a number");
  }
}

std::pair<double, double> Chain::Parts::site(long j) const {
  const long n = static_cast<long>(problem.grid.sites);
  double now_shift = 0, old_shift = 0, sign = 1;
  const auto reflect = [&](long last, End kind) {
    j = 2 * last - j;
    if (kind != End::fixed) return;
    const auto [now, old] = site(last);
    sign = -1;
    now_shift = 2 * now;
    old_shift = 2 * old;
  };
  if (problem.boundary.periodic) {
    const long around = j < 0 ? -1 : j >= n ? 1 : 0;
    now_shift = old_shift = -static_cast<double>(around * problem.boundary.charge);
  } else if (j < 0) {
    reflect(0, problem.boundary.left);
  } else if (j >= n) {
    reflect(n - 1, problem.boundary.right);
  }
  std::size_t i = 0;  // sites before the first slab and behind the last are in their halos
  while (i + 1 < slabs.size() && j >= static_cast<long>(slabs[i + 1].begin())) ++i;
  const long k = j - static_cast<long>(slabs[i].begin());
  return {sign * slabs[i].now()[k] + now_shift, sign * slabs[i].old()[k] + old_shift};
}

}  // namespace slipfront::chain
