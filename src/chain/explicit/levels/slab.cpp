#include "chain/explicit/levels/slab.hpp"

#include <algorithm>
#include <cstring>

namespace slipfront::chain {
namespace {

void copy(const double* from, double* to, std::size_t count) { std::memcpy(to, from, count * sizeof(double)); }

/// Asks the processor to load some sites of the next tile into its cache while it computes this one.
void prefetch(const double* sites, std::size_t count) {
#if defined(__GNUC__)
  for (std::size_t j = 0; j < count; j += 8) __builtin_prefetch(sites + j, 1, 2);
#else
  static_cast<void>(sites + count);
#endif
}

bool is_end(EndCondition side) { return side != EndCondition::joined && side != EndCondition::seam; }

}  // namespace

Aligned::Aligned(std::size_t size)
    : data_(static_cast<double*>(::operator new[]((size + 1) * sizeof(double), std::align_val_t{64}))) {
  std::fill_n(data_.get(), size + 1, 0.0);
}

Slab::Slab(std::size_t begin, std::size_t size, const EndConditions& ends)
    : begin_(begin),
      size_(size),
      ends_(ends),
      levels_{Aligned(size + 2 * margin + lanes), Aligned(size + 2 * margin + lanes)} {}

EndSites before_neighbours(const EndConditions& s, const double* next, std::size_t first, std::size_t last) {
  EndSites bare;
  if (s.left != EndCondition::joined) bare.left = next[first];
  if (s.left == EndCondition::seam) bare.left_of_seam = next[first - 1];
  if (s.right != EndCondition::joined) bare.right = next[last];
  if (s.right == EndCondition::seam) bare.right_of_seam = next[last + 1];
  return bare;
}

namespace {

/// A level just computed, for the site at an end and the sites on both ends of a seam.
struct LevelAtEnd {
  double spread, turns;
  const double *now, *y;
  double* next;

  /// Steps an absorbing end, and returns the energy that leaves.
  double absorb(const AbsorbingEnd& end, std::size_t j) const {
    const AbsorbingEnd::Step step = end.step(now + j, next + j);
    next[j] = step.next;
    return step.outflow;
  }
  /// The site to the left of the first is the last, across the seam. We add a turn to it for each dislocation.
  void first_of_chain(std::size_t j, double bare) const { next[j] = bare + spread * ((y[j - 1] + turns) + y[j + 1]); }
  void last_of_chain(std::size_t j, double bare) const { next[j] = bare + spread * (y[j - 1] + (y[j + 1] - turns)); }
};

void mend_left(const EndConditions& s, const EndSites& bare, const LevelAtEnd& level, std::size_t first,
               Outflow& outflow) {
  switch (s.left) {
    case EndCondition::free:
      level.next[first] = bare.left + level.spread * (level.y[first + 1] + level.y[first + 1]);
      break;
    case EndCondition::fixed:
      level.next[first] = level.now[first];
      break;
    case EndCondition::absorbing:
      outflow.left += level.absorb(s.absorbing_left, first);
      break;
    case EndCondition::seam:
      level.last_of_chain(first - 1, bare.left_of_seam);
      level.first_of_chain(first, bare.left);
      break;
    case EndCondition::joined:
      break;
  }
}

void mend_right(const EndConditions& s, const EndSites& bare, const LevelAtEnd& level, std::size_t last,
                Outflow& outflow) {
  switch (s.right) {
    case EndCondition::free:
      level.next[last] = bare.right + level.spread * (level.y[last - 1] + level.y[last - 1]);
      break;
    case EndCondition::fixed:
      level.next[last] = level.now[last];
      break;
    case EndCondition::absorbing:
      outflow.right += level.absorb(s.absorbing_right, last);
      break;
    case EndCondition::seam:
      level.last_of_chain(last, bare.right);
      level.first_of_chain(last + 1, bare.right_of_seam);
      break;
    case EndCondition::joined:
      break;
  }
}

constexpr std::size_t pad = lanes;  // the second loop reads y one site outside the tile and its halos
constexpr std::size_t tile_begin = pad + halo;

}  // namespace

void mend_ends(const EndConditions& s, const EndSites& bare, double spread, const double* now, const double* y,
               double* next, std::size_t first, std::size_t last, Outflow& outflow) {
  const LevelAtEnd level{spread, s.turns, now, y, next};
  mend_left(s, bare, level, first, outflow);
  mend_right(s, bare, level, last, outflow);
}

void Slab::advance(const Scheme& scheme, const double* a2, std::size_t count, std::size_t tile) {
  tile = std::max(std::min(tile, (size_ + lanes - 1) / lanes * lanes), 2 * halo);
  const std::size_t room = tile + 2 * halo + 2 * pad;
  if (tile_.size != room) tile_ = Tile(room, a2 != nullptr);
  copy(now() - halo, tile_.left_now.data(), halo);
  copy(old() - halo, tile_.left_old.data(), halo);
  for (std::size_t from = 0, width = 0; from < size_; from += width) {
    width = std::min(tile, size_ - from);
    // The last tile is at least as wide as a halo, so that the end of the chain is in no other tile's halo.
    if (from + width < size_ && size_ - from - width < halo) width -= halo;
    load(from, width);
    if (a2 != nullptr) {
      const std::size_t end = (tile_begin + width + halo + lanes - 1) / lanes * lanes;
      contact_coefficients(scheme.contact, a2 + from - tile_begin, tile_.coefficients.data(), pad, end);
    }
    advance_tile(scheme.rule, a2 != nullptr, count, tile, from, width);
  }
}

/// Copies `width` sites and their halos from both levels, and stores the sites left of the next tile, which this tile
/// will overwrite.
void Slab::load(std::size_t from, std::size_t width) {
  double *const z = tile_.now.data(), *const old_z = tile_.next.data();
  copy(tile_.left_now.data(), z + pad, halo);
  copy(tile_.left_old.data(), old_z + pad, halo);
  copy(now() + from, z + tile_begin, width + halo);
  copy(old() + from, old_z + tile_begin, width + halo);
  if (width < halo) return;
  copy(now() + from + width - halo, tile_.left_now.data(), halo);
  copy(old() + from + width - halo, tile_.left_old.data(), halo);
}

void Slab::advance_tile(const LevelRule& rule, bool contact, std::size_t count, std::size_t tile, std::size_t from,
                        std::size_t width) {
  double *z = tile_.now.data(), *next = tile_.next.data(), *const y = tile_.y.data();
  const std::size_t first = tile_begin, last = first + width - 1;
  EndConditions ends = ends_;
  if (from > 0) ends.left = EndCondition::joined;
  if (from + width < size_) ends.right = EndCondition::joined;
  // On a side with a halo, the range shrinks by one site at each level. We round it outwards to whole vectors, which
  // never exceed the pad.
  const std::size_t share = (std::min(tile, size_ - from - width) / count + lanes) / lanes * lanes;
  for (std::size_t level = 0; level < count; ++level) {
    if (from + width < size_) {
      prefetch(now() + from + width + halo + level * share, share);
      prefetch(old() + from + width + halo + level * share, share);
    }
    const std::size_t left = is_end(ends.left) ? first : pad + level;
    const std::size_t right = is_end(ends.right) ? last + 1 : last + 1 + halo - level;
    const std::size_t begin = left / lanes * lanes, end = (right + lanes - 1) / lanes * lanes;
    if (contact)
      local_part_with_coefficients(rule, tile_.coefficients.data(), z, next, next, y, begin, end);
    else
      local_part(rule, z, next, next, y, begin, end);
    const EndSites bare = before_neighbours(ends, next, first, last);
    add_neighbours(rule.spread, y, next, begin, end);
    mend_ends(ends, bare, rule.spread, z, y, next, first, last, outflow);
    std::swap(z, next);
  }
  copy(z + tile_begin, now() + from, width);
  copy(next + tile_begin, old() + from, width);
}

}  // namespace slipfront::chain
