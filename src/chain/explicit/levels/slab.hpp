#pragma once

#include <cstddef>
#include <memory>
#include <new>
#include <vector>

#include "chain/explicit/levels/absorbing_end.hpp"
#include "chain/explicit/levels/scheme.hpp"

namespace slipfront::chain {

/// Doubles from a multiple of 64 bytes on, zero at first.
class Aligned {
 public:
  explicit Aligned(std::size_t size = 0);
  double* data() { return data_.get(); }
  const double* data() const { return data_.get(); }

 private:
  struct Free {
    void operator()(double* p) const { ::operator delete[](p, std::align_val_t{64}); }
  };
  std::unique_ptr<double[], Free> data_;
};

/// Levels that are computed between two exchanges of halos, and so the depth of a halo: a chain in memory is read and
/// written once in that many levels.
inline constexpr std::size_t halo = 32;

/// What holds at the two ends of a stretch of sites, level by level.
enum class Side { joined, free, fixed, absorbing, seam };
struct Sides {
  Side left = Side::joined, right = Side::joined;  ///< joined: a halo; seam: too, from the other end
  double turns = 0;                                ///< u falls by so many turns around
  AbsorbingEnd beyond_left, beyond_right;          ///< for absorbing ends
};

/// Energy that has left through absorbing ends.
struct Outflow {
  double left = 0, right = 0;
};

/// Sites [begin, begin + size) of a chain at two levels, with halos: what one thread (or one process) has. The halos
/// are the owner's to fill before each advance.
class Slab {
 public:
  Slab(std::size_t begin, std::size_t size, const Sides& sides);

  std::size_t begin() const { return begin_; }
  std::size_t size() const { return size_; }
  double* now() { return levels_[current_].data() + margin; }
  double* old() { return levels_[1 - current_].data() + margin; }
  const double* now() const { return levels_[current_].data() + margin; }
  const double* old() const { return levels_[1 - current_].data() + margin; }
  const Sides& sides() const { return sides_; }
  void swap() { current_ = 1 - current_; }

  /// `count` <= halo levels, tile by tile in cache, in place. Bits do not depend on `tile` (a multiple of lanes).
  void advance(const LevelRule& rule, std::size_t count, std::size_t tile);

  Outflow outflow;  ///< through its ends

 private:
  static constexpr std::size_t margin = 2 * halo;
  std::size_t begin_, size_;
  Sides sides_;
  Aligned levels_[2];
  std::size_t current_ = 0;
};

/// What the ends add to a level just computed: `first` and `last` are the sites at the ends of the chain where `sides`
/// has one (or where the seam lies), `bare` what local_part left there.
struct EndSites {
  double left_bare = 0, left_beyond_bare = 0, right_bare = 0, right_beyond_bare = 0;
};
EndSites before_neighbours(const Sides& sides, const double* next, std::size_t first, std::size_t last);
void mend_ends(const Sides& sides, const EndSites& bare, double spread, const double* now, const double* y,
               double* next, std::size_t first, std::size_t last, Outflow& outflow);

}  // namespace slipfront::chain
