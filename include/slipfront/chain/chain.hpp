#pragma once
/// \file
/// A chain of dislocations in time: Eq. 3 on a grid, or the lattice of Eq. 1, site by site (docs/chain.md). Explicit
/// and implicit steps are two classes behind the interface that this file declares.

#include <cstddef>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "slipfront/chain/problem.hpp"
#include "slipfront/output/slip_event.hpp"

namespace slipfront {
class Ranks;
}

namespace slipfront::chain {

/// How a run is carried out. It changes no bits of the results.
struct Execution {
  int threads = 1;          ///< of each rank
  std::size_t tile = 1472;  ///< sites that stay in the innermost cache for 32 levels; a multiple of 8
  /// Processes that share the chain, 64 sites or more each. They outlive it. Null: this process has the whole chain.
  const Ranks* ranks = nullptr;
};

/// Sites [begin, begin + u.size()) at one time, in the units of Motion.
struct Window {
  std::size_t begin = 0;
  std::vector<double> x, u, velocity;
  std::vector<double> stress;  ///< -u_x; of a lattice, the mean of the bonds on either side
};

/// Energy that has been supplied and has gone since the start, in units of Eq. 3.
struct Flows {
  double supplied = 0, dissipated = 0;  ///< by the forcing, by friction
  double outflow = 0;                   ///< through absorbing ends
  double by_contacts = 0;               ///< given to the substrate by contacts whose strength changes
};

/// Energy of springs.
struct SpringEnergy {
  /// Between sites, as the time steps conserve it. None: it is the sum over sites that `totals` takes.
  std::optional<double> between_sites;
  double loading = 0;  ///< of the springs that pull (Loading)
};

/// The sites of a chain at the present time, and the forces on them: all that measurements need.
///
/// Processes may share a chain, each with some of its sites. Calls marked (all) are messages between them: all make the
/// same calls in the same order with the same arguments, and get the same results, to the bits of a single process. An
/// error on one is thrown on all.
class Sites {
 public:
  virtual ~Sites() = default;

  const Problem& problem() const { return problem_; }
  const Ranks& ranks() const { return *ranks_; }
  virtual double time() const = 0;
  /// The time step, where all are equally long.
  virtual std::optional<double> constant_step() const = 0;

  /// (all) Sites [begin, end) at `time`, which is no more than a constant step away, or is the present time.
  /// \throws InputError for other sites or times.
  Window window(std::size_t begin, std::size_t end, double time) const;
  Window window(std::size_t begin, std::size_t end) const { return window(begin, end, time()); }
  /// (all) Gets the sites next to this rank's from the other ranks. `own_window` needs them.
  virtual void exchange() const = 0;
  /// Sites of this rank, and at most 4 next to them. Call `exchange` after each step before the first window.
  virtual Window own_window(std::size_t begin, std::size_t end, double time) const = 0;

  /// Forces on a site of this rank at the present time, as they occur in the equation of motion.
  virtual double contact_squared(std::size_t site) const = 0;            ///< a^2
  virtual double forcing(std::size_t site) const = 0;                    ///< F, with the pull of springs
  virtual double friction(std::size_t site, double velocity) const = 0;  ///< f
  /// 1 - p, the effective normal stress over the normal stress; 1 where friction has no pores.
  virtual double effective_stress(std::size_t site) const = 0;
  virtual SpringEnergy spring_energy() const = 0;

 protected:
  Sites(const Problem& problem, const Ranks* ranks);  ///< null: one process

 private:
  Problem problem_;
  const Ranks* ranks_;
};

/// A chain that moves. `make_chain` (chain/make_chain.hpp) chooses the steps that the problem asks for.
class Chain : public Sites {
 public:
  static constexpr long no_limit = std::numeric_limits<long>::max();

  virtual long steps() const = 0;  ///< since t = 0
  /// Whether the motion has come to `time`; with constant steps, to the step nearest to it.
  bool reached(double time) const;
  /// (all) Takes at most `most` steps towards `time`. Returns whether it is reached. \throws NumericsError with time
  /// and position where the motion cannot be followed.
  virtual bool advance_to(double time, long most = no_limit) = 0;
  /// Whether the motion is a valid one. It is not if an error has ended a step that overwrites the motion.
  virtual bool valid() const = 0;

  /// (all)
  virtual Flows flows() const = 0;
  /// Whether friction is among the flows. Explicit chains of more than 10 000 sites whose only force is viscous
  /// friction advance 32 levels at a time and do not meter its work: Totals has its rate.
  virtual bool meters_friction() const = 0;
  /// Slip events of a loaded chain so far, in its own units.
  virtual std::vector<output::SlipEvent> events() const = 0;

  /// (all) All that the chain needs to continue, to the same bits, as bytes.
  virtual std::string saved() const = 0;
  /// Continues from there. \throws InputError if the bytes do not fit the problem.
  virtual void resume(std::string_view saved) = 0;

 protected:
  using Sites::Sites;
};

}  // namespace slipfront::chain
