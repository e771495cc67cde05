#pragma once

#include <algorithm>
#include <cstddef>
#include <memory>
#include <new>
#include <vector>

#include "lattice/chain/explicit/levels/kernel.hpp"

namespace slipfront::chain {

/// An absorbing end, where the chain continues as a train at rest. Every disturbance of that train leaves without
/// reflection. The train at the end moves with the mean velocity U = tanh phi of the dislocations next to it. Its psi
/// is that of an outgoing wave with this phi (docs/theory/4_pulse.md). The wave is a fan if it pulls on the train
/// outside, and a shock if it pushes. The deviation v from that train obeys v_t +- v_x = 0. If there is no train
/// outside, u obeys it.
struct AbsorbingEnd {
  double psi0 = 0;                                   ///< psi of the train outside; 0: no train
  std::shared_ptr<const std::vector<double>> shock;  ///< table of psi - psi0 behind shocks, evenly spaced in ln phi
  double a = 1;                                      ///< contact ratio at the end
  double h = 0, dt = 0;                              ///< spacing, step
  double eps = 0;                                    ///< z = u + eps a^2 sin u
  int outward = 1;                                   ///< 1: right end, -1: left
  std::size_t reach = 0;                             ///< number of sites that give the velocity of the train

  struct Step {
    double next;     ///< z / 2 pi of the end at the next level
    double outflow;  ///< energy that leaves on the way there
  };
  /// Computes the table `shock` for a train with psi0 outside.
  static std::shared_ptr<const std::vector<double>> shocks_into(double psi0);

  /// Steps the end site. The arguments point to it at two levels; its neighbours must already have their next level.
  Step step(const double* now, const double* next) const;

 private:
  double psi_at(double phi_outward) const;
  double displacement(double z) const;
  double velocity_of_train(const double* now, const double* next) const;
};

/// Numbers from a multiple of 64 bytes on, zero at first.
template <class Number>
class AlignedArray {
 public:
  explicit AlignedArray(std::size_t size = 0)
      : data_(static_cast<Number*>(::operator new[]((size + unused) * sizeof(Number), std::align_val_t{64}))) {
    std::fill_n(data_.get(), size + unused, Number{});
  }
  Number* data() { return data_.get(); }
  const Number* data() const { return data_.get(); }

 private:
  /// Processors load memory ahead of a loop. Other threads must not write there.
  static constexpr std::size_t unused = 1024 / sizeof(Number);
  struct Free {
    void operator()(Number* p) const { ::operator delete[](p, std::align_val_t{64}); }
  };
  std::unique_ptr<Number[], Free> data_;
};
using Aligned = AlignedArray<double>;

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
