#pragma once

#include <cstddef>
#include <functional>
#include <optional>
#include <vector>

#include "slipfront/lattice/chain/problem.hpp"
#include "system/ranks.hpp"

namespace slipfront::chain {

/// The largest force F of Eq. 3 at which a grid of this spacing still holds a dislocation at rest (a = 1): the
/// Peierls-Nabarro barrier of the diamond rule, (40 pi / h^2) exp(-pi^2 / h), to 0.3 % for h = 0.25 to 0.7
/// (docs/chain.md).
double barrier_force(double spacing);

/// The spacing, not above the given one, at which the barrier is below `force`, to two digits.
double spacing_with_barrier_below(double force, double spacing);

class LocalTrain;

/// The start of a chain: a train of dislocations at rest whose local density follows a stress profile, <-u_x> =
/// stress(x) >= 0 (Eqs. 4-5 with U = 0). u falls with x. Where there is no stress, u stays in a well, a multiple of
/// 2 pi, 0 at the right end. A segment with no stress at either end holds a whole number of dislocations: its stress is
/// changed by the less than half a dislocation that this takes. If the whole chain is stressed and the stress jumps,
/// the jump is midway between two dislocations, where u is smooth. With `whole` the entire chain holds a whole number,
/// as a periodic chain must. With `contact`, a(x), psi at x is that of stress / a: the substrate is a^2 as strong, and
/// the train of Eq. 4 holds in the local units a x (docs/theory/6_contact.md). Sites are computed on demand, so no
/// process need hold them all. The bits of a site do not depend on the range in which it is computed. A site costs some
/// microseconds where the stress changes.
class StaticTrain {
 public:
  /// Integrates the stress over the chain once. A stress that is too small for a train (train::smallest_stress, of
  /// stress / a) is treated as zero. \throws InputError for a stress that is negative or not finite.
  StaticTrain(std::function<double(double x)> stress, const Grid& grid, bool whole = false,
              std::function<double(double x)> contact = {});

  /// Sites [begin, end).
  Motion operator()(std::size_t begin, std::size_t end) const;

 private:
  /// The running integral of the stress over 2 pi: dislocations left of a site.
  struct Charge {
    double sum = 0, lost = 0;  ///< compensated: 1e8 sites
    void add(double more);
  };
  /// Consecutive sites with stress, or without.
  struct Segment {
    std::size_t begin = 0, end = 0;
    bool empty = false;
    double from = 0, to = 0;  ///< charge at its edges
    double wells = 0;         ///< dislocations right of it
  };
  static constexpr std::size_t piece = 4096;  ///< the charge is kept at every so many sites

  double u(const Segment& segment, std::size_t site, double charge, LocalTrain& train) const;

  std::function<double(double)> stress_, contact_;
  Grid grid_;
  bool whole_;
  std::optional<double> jump_at_;  ///< dislocations left of the hardest jump from one stress to another
  std::vector<Charge> charges_;
  std::vector<Segment> segments_;
};

/// All sites of StaticTrain.
Motion static_train(const std::function<double(double x)>& stress, const Grid& grid, bool whole = false,
                    const std::function<double(double x)>& contact = {});

/// Calls `start(begin, end)`. \throws InputError if the result does not have end - begin sites.
Motion sites_of(const MotionOf& start, const Problem& problem, std::size_t begin, std::size_t end);
/// Makes a MotionOf from the motion of the whole chain. `start` must outlive the result.
MotionOf pieces_of(const Motion& start, std::size_t sites);

/// \throws InputError if the chain has too few sites for so many ranks.
void check_ranks(const Problem& problem, const Ranks& ranks);

/// Checks an initial motion while a chain reads it.
class StartCheck {
 public:
  /// \throws InputError for a number that is not finite.
  void look(const Problem& problem, const Motion& motion, std::size_t first);
  /// (all) \throws InputError if the grid is too coarse for the steepest slope.
  void finish(const Problem& problem, const Ranks& ranks) const;

 private:
  double steepest_ = 0, at_ = 0;  ///< largest difference of u between two neighbours, and its x
};

/// \throws InputError if the ends of a periodic chain do not differ by its charge.
void check_charge(const Problem& problem, const MotionOf& start);

}  // namespace slipfront::chain
