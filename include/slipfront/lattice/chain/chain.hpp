#pragma once
/// \file
/// Computes how a chain of dislocations moves: Eq. 3 on a grid, or Eq. 1 for each site of a lattice (docs/chain.md).
/// This file declares the interface. Explicit and implicit time steps are two classes that implement it.

#include <cstddef>
#include <limits>
#include <optional>
#include <vector>

#include "slipfront/lattice/chain/problem.hpp"
#include "slipfront/text/output/slip_event.hpp"

namespace slipfront {
class Archive;
class Ranks;
}  // namespace slipfront

namespace slipfront::chain {

/// How a run uses the machine. The results do not depend on it, to the last bit.
struct Execution {
  int threads = 1;          ///< number of threads of each rank
  std::size_t tile = 1472;  ///< sites that stay in the innermost cache for 32 levels; a multiple of 8
  /// The processes that share the chain; each has 64 sites or more. The object must outlive the chain. If it is null,
  /// this process has the whole chain.
  const Ranks* ranks = nullptr;
};

/// Sites [begin, begin + u.size()) at one time, in the units of Motion.
struct Window {
  std::size_t begin = 0;
  std::vector<double> x, u, velocity;
  std::vector<double> stress;            ///< -u_x; of a lattice, the mean of the bonds on either side
  std::vector<double> contact_squared;   ///< a^2, at the present time
  std::vector<double> effective_stress;  ///< 1 - p, that over the normal stress; 1 without pores; at the present time
  std::vector<double> energy = {};       ///< u_t^2 / 2 + u_x^2 / 2 + a^2 (1 - cos u); of Sites::known only

  /// The columns that every window has.
  static constexpr std::vector<double> Window::*columns[] = {
      &Window::x, &Window::u, &Window::velocity, &Window::stress, &Window::contact_squared, &Window::effective_stress};
};

/// Energy that entered and left the chain since the start, in units of Eq. 3.
struct Flows {
  double supplied = 0, dissipated = 0;  ///< energy supplied by the forcing, and dissipated by friction
  double outflow = 0;                   ///< energy that left through absorbing ends
  double by_contacts = 0;               ///< energy that contacts of changing strength gave to the substrate
};

/// Energy stored in springs.
struct SpringEnergy {
  /// Energy of the springs between sites, in the form that the time steps conserve. If it is absent, `totals` computes
  /// the energy as a sum over sites.
  std::optional<double> between_sites;
  double loading = 0;  ///< energy of the springs that load the chain (Loading)
};

/// The sites of a chain at the present time, and the forces on them. Measurements need nothing else.
///
/// Several processes may share a chain; each has some of its sites. Calls marked (all) exchange messages between them.
/// All processes must make these calls in the same order with the same arguments. They get the same results as a single
/// process would, to the last bit. An error on one process is thrown on all.
class Sites {
 public:
  virtual ~Sites() = default;

  const Problem& problem() const { return problem_; }
  const Ranks& ranks() const { return *ranks_; }
  virtual double time() const = 0;
  /// The length of a time step; absent if the steps differ in length.
  virtual std::optional<double> constant_step() const = 0;

  /// (all) Returns sites [begin, end) at `time`. If the step is constant, `time` may differ from the present time by at
  /// most one step; otherwise it must be the present time. \throws InputError for other sites or times.
  Window window(std::size_t begin, std::size_t end, double time) const;
  Window window(std::size_t begin, std::size_t end) const { return window(begin, end, time()); }
  /// (all) Gets the sites next to those of this rank from the other ranks. `own_window` needs them.
  virtual void exchange() const = 0;
  /// Returns sites of this rank and at most 4 sites next to them. After each step, call `exchange` before the first
  /// window.
  virtual Window own_window(std::size_t begin, std::size_t end, double time) const = 0;
  /// All sites at the present time, if they are known already; else null.
  virtual const Window* known() const { return nullptr; }

  virtual SpringEnergy spring_energy() const = 0;
  /// Mean force on a site, or the stress at the pulled end, if springs load the chain; otherwise 0.
  virtual double load() const { return 0; }

 protected:
  Sites(const Problem& problem, const Ranks* ranks);  ///< `ranks` is null for one process

 private:
  Problem problem_;
  const Ranks* ranks_;
};

/// A chain that can advance in time. `make_chain` (chain/make_chain.hpp) creates one with explicit or implicit steps,
/// as the problem requires.
class Chain : public Sites {
 public:
  static constexpr long no_limit = std::numeric_limits<long>::max();

  virtual long steps() const = 0;  ///< number of steps since t = 0
  /// Whether the chain has reached `time`, or, with constant steps, the step nearest to `time`.
  bool reached(double time) const;
  /// (all) Takes at most `most` steps towards `time`, and returns whether the chain has reached it. \throws
  /// NumericsError, with time and position, if the steps cannot resolve the motion.
  virtual bool advance_to(double time, long most = no_limit) = 0;
  /// Whether the present motion is that between two steps. Otherwise it is shown only, and the next step does not start
  /// from it.
  virtual bool between_steps() const { return true; }
  /// Whether the stored motion is valid. It is invalid after an error in a step that overwrites the motion.
  virtual bool valid() const = 0;

  virtual Flows flows() const = 0;  ///< (all)
  /// The number of the slip event in progress, from 1; 0 if there is none.
  virtual std::size_t event_in_progress() const { return 0; }
  /// The slip events of a loaded chain so far, in the units of the chain.
  virtual std::vector<output::SlipEvent> events() const = 0;
  /// When they arrived at Loading::fronts positions.
  virtual output::FrontRecords fronts() const { return {}; }

  /// (all) Writes or reads the state from which the chain continues without changing a bit of the results. \throws
  /// InputError if what it reads does not fit the problem.
  virtual void archive(Archive& a) = 0;

 protected:
  using Sites::Sites;
};

}  // namespace slipfront::chain
