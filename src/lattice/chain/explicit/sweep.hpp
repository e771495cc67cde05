#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "lattice/chain/explicit/forces.hpp"
#include "lattice/chain/explicit/levels/phases.hpp"
#include "lattice/chain/explicit/levels/slab.hpp"
#include "lattice/chain/model/blocks.hpp"

namespace slipfront::chain {

/// Measures the work of the forcing and of friction on the sites of one rank, for each level and block. It has the
/// fourth order of the scheme. For a step from u to u + D, with the second difference B over levels, the work follows
/// from
///     int F u_t dt = F_mean D + (F_next - F_before) B / 12,     int u_t^2 dt = (D^2 + B^2 / 12) / dt,
/// up to terms that cancel from step to step. A force that does not change has the potential -F u: its work follows
/// from u at the start and now.
class WorkMeter {
 public:
  WorkMeter(const Problem& problem, const Scheme& scheme, const Blocks& blocks, std::size_t first_block,
            std::size_t end_block);

  /// The measure of each step in the first loop.
  Measured of_each_step() const { return of_each_step_; }
  /// Whether the work needs the step before each step.
  bool needs_step_before() const { return problem_->forcing && !problem_->steady_forcing; }
  /// The measure of the first loop on sites [begin, end), whole blocks that are at `at` in its arrays.
  StepOfU step(std::size_t begin, std::size_t end, std::size_t at);

  /// A step of consecutive sites.
  struct Steps {
    const double *D, *D_before, *u;  ///< u (turns) at the end of the step
    long ahead;                      ///< levels of its end after the present one of the forces
    const double* applied;           ///< friction that is steep at rest
    friction::LocalStates states;
    double* scratch;  ///< room for as many numbers
  };
  /// Measures all other work, for a step of such sites from the level of the forces.
  void add(const Forces& forces, std::size_t begin, std::size_t end, const Steps& steps);
  /// Adds `strength` times F u of a force that does not change, at sites [begin, end), to the energies supplied.
  void add_potential(double strength, const double* F, std::size_t begin, std::size_t end, const double* u,
                     std::vector<double>& energies) const;

  /// The energies of each block of this rank, one block after the other: those supplied, dissipated, and, if contacts
  /// change, given to the substrate by them; each as a sum of `lanes` numbers.
  std::vector<double> sums;
  static std::size_t sums_of_block(const Problem& p) { return lanes * kinds(p); }
  static std::size_t kinds(const Problem& p) { return p.friction.changes_contacts() ? 3 : 2; }

 private:
  enum Kind : std::size_t { supplied, dissipated, by_contacts };
  BlockSums sums_of(Kind kind, std::vector<double>& energies, std::size_t begin, std::size_t end,
                    std::size_t at = 0) const;
  void add_friction(std::size_t begin, std::size_t end, const Steps& steps);

  const Problem* problem_;
  double dt_, energy_of_turn_;  ///< energy of a unit force and a turn of one site
  Blocks blocks_;
  std::size_t first_block_, sums_of_block_;
  Measured of_each_step_ = Measured::nothing;
  std::vector<std::size_t> begins_;  ///< first sites of the blocks of this rank, and the end of the last block
};

/// Advances the sites of one slab, tile by tile. A tile stays in the innermost cache while it goes through many levels.
/// To the left and right it also computes sites of its neighbours, one fewer at each level. These do not depend on the
/// tiles, so that neither do the results.
class Sweep {
 public:
  /// The tiles begin and end at the sites `cuts`. If there is work to measure, they must be whole blocks. Each has at
  /// least as many sites as a halo, unless it is the only one.
  Sweep(Slab& slab, Forces& forces, WorkMeter& meter, std::vector<std::size_t> cuts);

  /// How many bytes of a site each level reads or writes. With fewer of them, more sites stay in the cache. The
  /// coefficients of contacts count by half: they are read in order, so that half of them may come from the next cache.
  static std::size_t bytes(const Forces& forces, const WorkMeter& meter);
  static constexpr std::size_t usual_bytes = 3 * sizeof(double);

  /// Gets the state variables of the sites next to the slab, which another thread may change while this one advances.
  void exchange_states();
  /// Advances by `count` levels, at most a halo.
  void advance(std::size_t count);
  /// The first site found in an advance whose displacement is no longer a number, or changes too much for phases of
  /// 32 bits.
  std::optional<std::size_t> wrong_site() const { return wrong_site_; }

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
  void find_wrong_site(const Tile& tile);
  void advance(const Tile& tile, std::size_t count);
  void advance_phases(const Tile& tile, std::size_t count);
  /// The states of a tile from index i on: one variable after the other, as vector code reads them.
  friction::EvolvingStates columns(std::size_t i) {
    if (forces_.variables() == 0) return {};
    return {states_.data() + i, forces_.variables(), 1, room_};
  }
  LevelSites sites_at(const Tile& tile, std::size_t rest);
  StepOfU first_step(const Tile& tile, const LevelSites& sites, StepOfU measured);
  StepOfU step(const Tile& tile);
  void take_turns(StepOfU& step);
  void finish_step(const Tile& tile, const LevelSites& sites);
  void last_step(const Tile& tile, std::size_t count);
  void prefetch(const Tile& tile, std::size_t level, std::size_t count) const;

  Slab& slab_;
  Forces& forces_;
  WorkMeter& meter_;
  std::vector<std::size_t> cuts_;
  std::size_t room_;
  Aligned arrays_[3];
  double *before_, *now_, *spare_;  ///< the levels, which take turns in these arrays
  Aligned y_, coefficients_, states_, applied_, u_, steps_[2];
  double *D_, *D_before_;        ///< the last two steps, which take turns in `steps_` if both are needed
  Aligned left_now_, left_old_;  ///< the sites left of the next tile before this one changes them
  Aligned left_states_, right_states_;
  std::optional<std::size_t> wrong_site_;
  std::optional<PhaseTile> phases_;  ///< computes the levels if phases have 32 bits
};

}  // namespace slipfront::chain
