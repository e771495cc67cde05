#pragma once

#include <cstddef>
#include <memory>
#include <new>
#include <vector>

#include "chain/explicit/levels/absorbing_end.hpp"
#include "chain/explicit/levels/kernel.hpp"

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

/// The conditions at the two ends of consecutive sites, level by level.
enum class EndCondition { joined, free, fixed, absorbing, seam };
/// Whether the chain ends there.
inline bool is_end(EndCondition side) { return side != EndCondition::joined && side != EndCondition::seam; }
struct EndConditions {
  EndCondition left = EndCondition::joined,
               right = EndCondition::joined;  ///< joined: a halo; seam: a halo from the other end of a ring
  double turns = 0;                           ///< fall of u around a ring, in turns
  AbsorbingEnd absorbing_left, absorbing_right;
};

/// Energy that has left through absorbing ends.
struct Outflow {
  double left = 0, right = 0;
};

/// Sites [begin, begin + size) of a chain at two levels, with halos: the share of one thread. The owner fills the halos
/// before each advance.
class Slab {
 public:
  Slab(std::size_t begin, std::size_t size, const EndConditions& ends);

  std::size_t begin() const { return begin_; }
  std::size_t size() const { return size_; }
  double* now() { return now_.data() + margin; }
  double* old() { return old_.data() + margin; }
  const double* now() const { return now_.data() + margin; }
  const double* old() const { return old_.data() + margin; }
  const EndConditions& ends() const { return ends_; }

  Outflow outflow;  ///< through its ends

 private:
  static constexpr std::size_t margin = 2 * halo;
  std::size_t begin_, size_;
  EndConditions ends_;
  Aligned now_, old_;
};

/// The results of local_part at the ends of the chain, or on both ends of a seam, before neighbours are added.
struct EndSites {
  double left = 0, left_of_seam = 0, right = 0, right_of_seam = 0;
};
EndSites before_neighbours(const EndConditions& ends, const double* next, std::size_t first, std::size_t last);
/// Replaces a level just computed at its ends, sites `first` and `last`, and across a seam.
void mend_ends(const EndConditions& ends, const EndSites& bare, double spread, const double* now, const double* y,
               double* next, std::size_t first, std::size_t last, Outflow& outflow);

}  // namespace slipfront::chain
