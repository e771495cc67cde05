#pragma once
/// \file
/// A chain of dislocations in time: Eq. 3 on a grid, or the lattice of Eq. 1, site by site (docs/chain.md).

#include <cstddef>
#include <functional>
#include <memory>
#include <vector>

#include "slipfront/chain/events.hpp"
#include "slipfront/chain/problem.hpp"

namespace slipfront {
class Ranks;
}

namespace slipfront::chain {

struct Inside;

/// How a run is carried out; changes no bits of it.
struct Execution {
  int threads = 1;          ///< of each rank
  std::size_t tile = 1472;  ///< sites that stay in the innermost cache for 32 levels; a multiple of 8
  /// Processes that share the chain, 64 sites or more each; they outlive it. Null: this one has it all.
  const Ranks* ranks = nullptr;
};

/// All that a chain needs to go on, to the same bits: two levels of z / 2 pi (docs/chain.md), and what the places
/// remember if friction depends on that.
struct Levels {
  long level = 0;  ///< steps done
  std::vector<double> now, before;
  /// The friction law's variables, site by site, and those of contacts that change (chain/explicit/contact_field.hpp);
  /// empty at a start.
  std::vector<double> memory = {};
};

/// The motion, or the levels, of sites [begin, end): for chains that nobody holds whole. Asked for some 65 536 sites at
/// a time, on each rank for its own sites and a few beside them.
using MotionOf = std::function<Motion(std::size_t begin, std::size_t end)>;
using LevelsOf = std::function<Levels(std::size_t begin, std::size_t end)>;

/// Sites [begin, begin + u.size()) at one time, in the units of Motion.
struct Window {
  std::size_t begin = 0;
  std::vector<double> x, u, velocity;
  std::vector<double> stress;  ///< -u_x; of a lattice, the mean of the bonds on either side
};

/// With Execution::ranks processes share a chain, each with some of its sites. All make the same calls in the same
/// order with the same arguments. All get the same results, to the bits of a single process. An error on one is thrown
/// on all.
class Chain {
 public:
  /// \throws InputError as check(Problem) does, for a motion that does not fit the grid or is too steep for it (too few
  /// sites to a dislocation), and for a periodic chain whose ends do not differ by its charge. More ranks than the
  /// chain has room for are an InputError too.
  Chain(const Problem& problem, const Motion& start, const Execution& execution = {});
  Chain(const Problem& problem, const MotionOf& start, const Execution& execution = {});
  /// Continues, with any number of threads and ranks. \throws InputError if the levels do not fit the problem.
  Chain(const Problem& problem, const Levels& saved, const Execution& execution = {});
  Chain(const Problem& problem, long level, const LevelsOf& saved, const Execution& execution = {});
  ~Chain();
  Chain(Chain&&) noexcept;
  Chain& operator=(Chain&&) noexcept;

  /// \throws NumericsError with time and site where the displacement is no longer a number.
  void advance(long levels);
  /// To the level nearest to `time`. `interrupted` is asked every 32 levels or more; true, on any rank, stops early.
  /// Returns whether `time` was reached.
  bool advance_to(double time, const std::function<bool()>& interrupted = {});

  /// Whether steps are implicit (Problem::implicit); then `advance` and `levels` are not for it.
  bool implicit() const;
  /// At most `most` implicit steps, to `until` and no farther; returns whether it was reached. \throws NumericsError
  /// with time and place where no step is short enough.
  bool proceed(double until, long most);
  /// All that implicit steps need to go on, to the same bits.
  std::vector<double> implicit_state() const;
  void continue_implicit(const std::vector<double>& state);
  /// Slip events of a loaded chain so far, in its own units.
  std::vector<Event> events() const;

  /// Energy that has come in and gone since the start, in units of Eq. 3. A chain of more than 10 000 sites with
  /// viscous friction by itself takes 32 levels at a time and does not meter it: its rate is in Totals.
  struct Flows {
    double supplied = 0, dissipated = 0;  ///< by the forcing, by friction
    double outflow = 0;                   ///< through absorbing ends
    double by_contacts = 0;               ///< given to the substrate by contacts whose strength changes
  };
  Flows flows() const;
  /// The same block by block, to continue with.
  std::vector<double> flow_sums() const;
  void continue_flows(const std::vector<double>& sums);
  /// Whether friction is among the flows.
  bool meters_friction() const;

  const Problem& problem() const;
  long level() const;
  double dt() const;
  double time() const;

  /// All sites, or [begin, end), on rank 0; none on others. A piece at a time, no rank need hold them all.
  Levels levels() const;
  Levels levels(std::size_t begin, std::size_t end) const;

  /// Sites [begin, end) at `time`, which is no more than a step away; fourth order in u and velocity.
  Window window(std::size_t begin, std::size_t end, double time) const;
  Window window(std::size_t begin, std::size_t end) const { return window(begin, end, time()); }

  /// Forces on a site of this rank as they stand in the equation of motion, for inspection.
  double contact_squared(std::size_t site) const;            ///< a^2
  double forcing(std::size_t site) const;                    ///< F now
  double friction(std::size_t site, double velocity) const;  ///< f
  /// 1 - p, the effective normal stress over the normal stress; 1 where pores do not count.
  double effective_stress(std::size_t site) const;

 private:
  friend struct Inside;
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

}  // namespace slipfront::chain
