#pragma once

#include <cstddef>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "lattice/chain/explicit/levels/kernel.hpp"
#include "lattice/chain/explicit/share.hpp"
#include "slipfront/lattice/chain/chain.hpp"

namespace slipfront::chain {

class RankSites;

/// A chain that advances by explicit steps, all equally long: level by level of the diamond rule, or of leapfrog on a
/// lattice (docs/chain.md).
class ExplicitChain final : public Chain {
 public:
  /// \throws InputError as check(Problem) does, for a motion that does not fit the grid or is too steep for it (too few
  /// sites to a dislocation), for a periodic chain whose ends do not differ by its charge, and for more ranks than the
  /// chain has room for.
  ExplicitChain(const Problem& problem, const MotionOf& start, const Execution& execution = {});
  ExplicitChain(const Problem& problem, const Motion& start, const Execution& execution = {});
  /// Continues, with any number of threads and ranks. \throws InputError if the levels do not fit the problem.
  ExplicitChain(const Problem& problem, long level, const LevelsOf& saved, const Execution& execution = {});
  ExplicitChain(const Problem& problem, const Levels& saved, const Execution& execution = {});
  ~ExplicitChain() override;
  ExplicitChain(ExplicitChain&&) noexcept;
  ExplicitChain& operator=(ExplicitChain&&) = delete;

  double dt() const;
  /// (all) \throws NumericsError with time and site where the displacement is no longer a number.
  void advance(long levels);
  /// (all) All sites, or [begin, end), on rank 0; none on others. A piece at a time, no rank need hold them all.
  Levels levels() const;
  Levels levels(std::size_t begin, std::size_t end) const;
  /// (all) The flows block by block.
  std::vector<double> flow_sums() const;

  double time() const override;
  std::optional<double> constant_step() const override { return dt(); }
  void exchange() const override;
  Window own_window(std::size_t begin, std::size_t end, double time) const override;
  SpringEnergy spring_energy() const override { return {}; }

  long steps() const override;
  bool advance_to(double time, long most = no_limit) override;
  bool valid() const override { return valid_; }
  Flows flows() const override;
  std::vector<output::SlipEvent> events() const override { return {}; }
  void archive(Archive& a) override;

 private:
  void start_from(long level, const LevelsOf& saved);

  Execution execution_;
  std::unique_ptr<RankSites> share_;
  bool valid_ = true;
};

/// Sites [from, to) of a share, or of at most 4 next to it, after an exchange, at `time`, which is no more than a step
/// away. u and velocity are of fourth order.
Window window_of(const RankSites& share, std::size_t from, std::size_t to, double time);

}  // namespace slipfront::chain
