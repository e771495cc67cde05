#pragma once

#include <cstddef>
#include <vector>

#include "chain/explicit/forces.hpp"
#include "chain/explicit/levels/slab.hpp"
#include "chain/explicit/work_meter.hpp"

namespace slipfront::chain {

/// Advances the sites of one slab, tile by tile. A tile stays in the innermost cache while it goes through many levels.
/// To the left and right it also computes sites of its neighbours, one fewer at each level. These do not depend on the
/// tiles, so that neither do the results.
class Sweep {
 public:
  /// The tiles begin and end at the sites `cuts`. If there is work to measure, they must be whole blocks. Each has at
  /// least as many sites as a halo, unless it is the only one.
  Sweep(Slab& slab, Forces& forces, WorkMeter& meter, std::vector<std::size_t> cuts);

  /// Gets the state variables of the sites next to the slab, which another thread may change while this one advances.
  void exchange_states();
  /// Advances by `count` levels, at most a halo.
  void advance(std::size_t count);

 private:
  /// One tile during an advance, as indices of its arrays.
  struct Tile {
    std::size_t from, width;  ///< its first site in the slab, and its number of sites
    long offset;              ///< the site at index 0
    EndConditions ends;
  };
  Tile tile(std::size_t piece) const;
  void load(const Tile& tile);
  void load_states(const Tile& tile);
  void store(const Tile& tile);
  void advance(const Tile& tile, std::size_t count);
  LevelSites sites_at(const Tile& tile, std::size_t rest);
  void begin_steps(const LevelSites& sites, std::size_t last);
  void finish_step(const Tile& tile, const LevelSites& sites);
  void last_step(const Tile& tile);
  void prefetch(const Tile& tile, std::size_t level, std::size_t count) const;

  Slab& slab_;
  Forces& forces_;
  WorkMeter& meter_;
  std::vector<std::size_t> cuts_;
  std::size_t room_;
  Aligned arrays_[3];
  double *before_, *now_, *spare_;  ///< the levels, which take turns in these arrays
  Aligned y_, coefficients_, states_, applied_, u_, steps_[2], B_;
  double *D_, *D_before_;        ///< the last two steps, which take turns in `steps_`
  Aligned left_now_, left_old_;  ///< the sites left of the next tile before this one changes them
  Aligned left_states_, right_states_;
};

}  // namespace slipfront::chain
