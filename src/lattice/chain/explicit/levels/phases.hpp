#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "lattice/chain/explicit/levels/kernel.hpp"
#include "lattice/chain/explicit/levels/scheme.hpp"
#include "lattice/chain/explicit/levels/slab.hpp"

/// Phases of 32 bits (docs/chain.md). An integer counts 2^-32 of a turn: sums are exact, and overflow takes away whole
/// turns, as the sine does. Multiples of S, of steps and of second differences are computed in single precision, and
/// rounded to integers.
namespace slipfront::chain {

using Phase = std::uint32_t;

/// |z| is less than this many turns, so that doubles hold all bits of it.
inline constexpr double most_turns_of_phases = 1048576;

/// LevelRule in single precision, with S in units of phases and d2 y = y_left + y_right - 2 y. In the numbers of
/// LevelRule, and with D = z - z_old,
///     next = z + D - (1 - before) D - (force + 2 spread coupled) S + spread d2 y.
/// If spread is above 1/2, d2 y is added exactly, and only (spread - 1) d2 y is rounded.
struct PhaseRule {
  explicit PhaseRule(const Scheme& scheme);

  float c[PeriodicForce::terms];  ///< coefficients of S as a function of z in turns
  float eps, coupled, force, damping;
  bool whole_bend;  ///< whether d2 y is added exactly
  float bend;       ///< spread, less 1 if it is
};

/// The levels of one tile with phases of 32 bits.
class PhaseTile {
 public:
  /// `room` as in the arrays of the tile in doubles; `measures`: whether steps of u are measured.
  PhaseTile(const Scheme& scheme, std::size_t room, bool measures);

  struct Range {
    std::size_t begin, end;
  };
  /// Gets two levels on the indices `all`, of which those of `own` belong to the tile.
  void load(const double* before, const double* now, Range all, Range own);
  /// Computes the next level of some sites, and measures the step to the present one: nothing, steps or squares.
  void advance(const EndConditions& ends, Range sites, const StepOfU& measured);
  /// Writes the levels of the sites of the tile, and then measures the step to the last one.
  void finish(double* before, double* now, const StepOfU& measured);
  /// The first of these sites whose z differed by 0.45 turns or more from the next one of them or from the level
  /// before; the end of the tile if there was none. From half a turn on, phases go the shorter way around.
  std::size_t first_not_followed() const { return not_followed_; }

 private:
  void measured_part(const StepOfU& measured);

  PhaseRule rule_;
  bool measures_;
  AlignedArray<Phase> arrays_[3];
  AlignedArray<float> of_steps_[2];
  Phase *now_, *old_;  ///< the levels, which take turns in two of the arrays
  Phase* y_;
  float *shift_, *D_;        ///< z - u at the level before, and the step of u to it
  std::vector<float> sums_;  ///< sums of blocks in one step
  Range own_{};
  std::size_t not_followed_ = 0;
  std::int64_t first_ = 0;  ///< z of the first site, in units of phases, with its whole turns
};

}  // namespace slipfront::chain
