#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "lattice/chain/events/event_log.hpp"
#include "lattice/chain/implicit/implicit_step.hpp"
#include "lattice/chain/implicit/site_forces.hpp"
#include "slipfront/lattice/chain/chain.hpp"

namespace slipfront::chain {

/// The middles of `count` equal parts of a chain, in b / A.
std::vector<double> middles_of_parts(const Problem& problem, std::size_t count);

/// The equal parts of a chain that are watched for slip events, at most 64: each has eight dislocations or more, or is
/// 60 widths of one long. A smooth surface has no dislocations, and its parts have eight sites or more. Sums over a
/// part are sums over its pieces (Blocks::each_piece), added in order, so the results do not depend on the ranks.
class WatchedParts {
 public:
  /// (all) The parts of the motion `now` of the start. `forces` must outlive this object.
  WatchedParts(const SiteForces& forces, const ChainState& now);

  /// (all) Hands the last step to the log of events of `m`. Slip counts as positive in the direction of the springs.
  void look(ChainState& m);
  /// (all) The load at this moment: the mean force on a site, or the stress at the end that is pulled.
  double load(const ChainState& m);

 private:
  struct Piece {
    std::size_t part, begin, end;  ///< sites of the chain
  };
  void add_up(const ChainState& m);
  double load_by_sums() const;

  const SiteForces& forces_;
  double direction_;  ///< 1, or -1 if the springs pull backward
  ChainParts parts_;
  std::vector<Piece> pieces_;       ///< those of all ranks
  std::size_t first_, count_ = 0;   ///< pieces of this rank
  std::vector<double> mine_, all_;  ///< sums over each piece: u, w, and the force that loads it
};

/// \throws InputError for conditions that implicit steps do not support, and for loading out of range.
void check_implicit(const Problem& problem, const Execution& execution);

/// A chain that advances by implicit steps of any length (ImplicitStep): for loading, and for whatever is slow
/// (docs/loading.md). The length of a step follows an estimate of its error.
///
/// Steps do not depend on the times at which the motion is observed. A step that passes such a time is kept, and a
/// second, shorter step from the same start gives the motion at that time. It is only shown.
class ImplicitChain final : public Chain {
 public:
  /// \throws InputError as ExplicitChain does, and for conditions that implicit steps do not support: absorbing ends,
  /// friction that jumps at rest.
  ImplicitChain(const Problem& problem, const MotionOf& start, const Execution& execution = {});
  ImplicitChain(const Problem& problem, const Motion& start, const Execution& execution = {});
  ImplicitChain(const ImplicitChain&) = delete;
  ImplicitChain& operator=(const ImplicitChain&) = delete;

  double time() const override { return now_.time; }
  std::optional<double> constant_step() const override { return std::nullopt; }
  void exchange() const override;
  Window own_window(std::size_t begin, std::size_t end, double time) const override;
  SpringEnergy spring_energy() const override;
  double load() const override { return parts_.load(now_); }

  long steps() const override { return now_.steps; }
  /// Counts the steps that are only shown, too. \throws NumericsError where no step is short enough.
  bool advance_to(double time, long most = no_limit) override;
  bool between_steps() const override { return !passed_; }
  bool valid() const override { return true; }  // a step that fails is not taken
  Flows flows() const override;
  std::size_t event_in_progress() const override { return now_.log.in_progress(); }
  std::vector<output::SlipEvent> events() const override { return now_.log.events(); }
  output::FrontRecords fronts() const override { return now_.fronts.records(); }
  /// Writes the start of a step that has passed the present time. Reading takes this step again.
  void archive(Archive& a) override;

 private:
  void step();
  void step_to(double time);
  void finish_step();
  void look_at_fronts();
  void check_progress();
  void give_up() const;
  void fail(const std::string& why) const;

  /// The numbers of a site that a window shows.
  struct Shown {
    double u = 0, velocity = 0, contact_squared = 0, effective_stress = 0;
  };
  static constexpr std::size_t halo = 8;  ///< sites next to those of this rank that a window may need, on either side
  using Halo = std::array<double, 4 * halo>;
  std::size_t own(std::size_t site) const { return site - forces_.own().begin; }
  Shown shown(long site) const;
  double displacement(long site) const;

  ChainState now_;
  SiteForces forces_;
  ImplicitStep step_;
  mutable WatchedParts parts_;               ///< mutable, because it stores the sums over parts
  mutable Halo before_own_{}, after_own_{};  ///< got by `exchange`
  /// The step that has passed the time of `now_`: its start and its end, if there is one.
  ChainState before_, after_;
  bool passed_ = false;
};

}  // namespace slipfront::chain
