#include "chain/explicit/levels/slab.hpp"

#include <algorithm>
#include <cstring>

namespace slipfront::chain {
namespace {

void copy(const double* from, double* to, std::size_t count) { std::memcpy(to, from, count * sizeof(double)); }

/// Asks for sites of the next tile while this one is computed, a share each level.
void prefetch(const double* sites, std::size_t count) {
#if defined(__GNUC__)
  for (std::size_t j = 0; j < count; j += 8) __builtin_prefetch(sites + j, 1, 2);
#else
  static_cast<void>(sites + count);
#endif
}

bool is_end(Side side) { return side != Side::joined && side != Side::seam; }

}  // namespace

Aligned::Aligned(std::size_t size)
    : data_(static_cast<double*>(::operator new[]((size + 1) * sizeof(double), std::align_val_t{64}))) {
  std::fill_n(data_.get(), size + 1, 0.0);
}

Slab::Slab(std::size_t begin, std::size_t size, const Sides& sides)
    : begin_(begin),
      size_(size),
      sides_(sides),
      levels_{Aligned(size + 2 * margin + lanes), Aligned(size + 2 * margin + lanes)} {}

EndSites before_neighbours(const Sides& s, const double* next, std::size_t first, std::size_t last) {
  EndSites bare;
  if (s.left != Side::joined) bare.left_bare = next[first];
  if (s.left == Side::seam) bare.left_beyond_bare = next[first - 1];
  if (s.right != Side::joined) bare.right_bare = next[last];
  if (s.right == Side::seam) bare.right_beyond_bare = next[last + 1];
  return bare;
}

void mend_ends(const Sides& s, const EndSites& bare, double spread, const double* now, const double* y, double* next,
               std::size_t first, std::size_t last, Outflow& outflow) {
  const auto absorb = [&](const AbsorbingEnd& end, std::size_t j) {
    const AbsorbingEnd::Step step = end.step(now + j, next + j);
    next[j] = step.next;
    return step.outflow;
  };
  // Across the seam: the site to the left of the first is the last, higher by a turn a dislocation.
  const auto first_of_chain = [&](std::size_t j, double w) {
    next[j] = w + spread * ((y[j - 1] + s.turns) + y[j + 1]);
  };
  const auto last_of_chain = [&](std::size_t j, double w) { next[j] = w + spread * (y[j - 1] + (y[j + 1] - s.turns)); };
  switch (s.left) {
    case Side::free:
      next[first] = bare.left_bare + spread * (y[first + 1] + y[first + 1]);
      break;
    case Side::fixed:
      next[first] = now[first];
      break;
    case Side::absorbing:
      outflow.left += absorb(s.beyond_left, first);
      break;
    case Side::seam:
      last_of_chain(first - 1, bare.left_beyond_bare);
      first_of_chain(first, bare.left_bare);
      break;
    case Side::joined:
      break;
  }
  switch (s.right) {
    case Side::free:
      next[last] = bare.right_bare + spread * (y[last - 1] + y[last - 1]);
      break;
    case Side::fixed:
      next[last] = now[last];
      break;
    case Side::absorbing:
      outflow.right += absorb(s.beyond_right, last);
      break;
    case Side::seam:
      last_of_chain(last, bare.right_bare);
      first_of_chain(last + 1, bare.right_beyond_bare);
      break;
    case Side::joined:
      break;
  }
}

void Slab::advance(const LevelRule& rule, std::size_t count, std::size_t tile) {
  constexpr std::size_t pad = lanes;  // y is read one site beyond
  tile = std::max(std::min(tile, (size_ + lanes - 1) / lanes * lanes), 2 * halo);
  const std::size_t room = tile + 2 * halo + 2 * pad;
  Aligned scratch_now(room), scratch_next(room), scratch_y(room);
  Aligned carry_now(halo), carry_old(halo);  // the sites left of the tile, as they were
  copy(now() - halo, carry_now.data(), halo);
  copy(old() - halo, carry_old.data(), halo);
  double* const y = scratch_y.data();

  for (std::size_t from = 0, width = 0; from < size_; from += width) {
    width = std::min(tile, size_ - from);
    // The last tile is no smaller than a halo: the end of the chain lies in no other tile's halo.
    if (from + width < size_ && size_ - from - width < halo) width -= halo;
    const std::size_t first = pad + halo, last = first + width - 1;
    double *z = scratch_now.data(), *next = scratch_next.data();
    copy(carry_now.data(), z + pad, halo);
    copy(carry_old.data(), next + pad, halo);
    copy(now() + from, z + first, width + halo);
    copy(old() + from, next + first, width + halo);
    if (width >= halo) {
      copy(now() + from + width - halo, carry_now.data(), halo);
      copy(old() + from + width - halo, carry_old.data(), halo);
    }
    Sides sides = sides_;
    if (from > 0) sides.left = Side::joined;
    if (from + width < size_) sides.right = Side::joined;
    // Where there is a halo the range shrinks by a site a level; rounded outwards to whole vectors, never beyond the
    // pad.
    const std::size_t share = (std::min(tile, size_ - from - width) / count + lanes) / lanes * lanes;
    for (std::size_t level = 0; level < count; ++level) {
      if (from + width < size_) {
        prefetch(now() + from + width + halo + level * share, share);
        prefetch(old() + from + width + halo + level * share, share);
      }
      const std::size_t left = is_end(sides.left) ? first : pad + level;
      const std::size_t right = is_end(sides.right) ? last + 1 : last + 1 + halo - level;
      const std::size_t begin = left / lanes * lanes, end = (right + lanes - 1) / lanes * lanes;
      local_part(rule, z, next, next, y, begin, end);
      const EndSites bare = before_neighbours(sides, next, first, last);
      add_neighbours(rule.spread, y, next, begin, end);
      mend_ends(sides, bare, rule.spread, z, y, next, first, last, outflow);
      std::swap(z, next);
    }
    copy(z + first, now() + from, width);
    copy(next + first, old() + from, width);
  }
}

}  // namespace slipfront::chain
