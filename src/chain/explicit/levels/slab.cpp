#include "chain/explicit/levels/slab.hpp"

#include <algorithm>

namespace slipfront::chain {

Aligned::Aligned(std::size_t size)
    : data_(static_cast<double*>(::operator new[]((size + 1) * sizeof(double), std::align_val_t{64}))) {
  std::fill_n(data_.get(), size + 1, 0.0);
}

Slab::Slab(std::size_t begin, std::size_t size, const EndConditions& ends)
    : begin_(begin), size_(size), ends_(ends), now_(size + 2 * margin + lanes), old_(size + 2 * margin + lanes) {}

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

}  // namespace

void mend_ends(const EndConditions& s, const EndSites& bare, double spread, const double* now, const double* y,
               double* next, std::size_t first, std::size_t last, Outflow& outflow) {
  const LevelAtEnd level{spread, s.turns, now, y, next};
  mend_left(s, bare, level, first, outflow);
  mend_right(s, bare, level, last, outflow);
}

}  // namespace slipfront::chain
