#pragma once

#include <utility>
#include <vector>

#include "forces.hpp"
#include "scheme.hpp"
#include "slab.hpp"
#include "slipfront/chain/chain.hpp"

namespace slipfront::chain {

/// A chain cut into slabs, a thread each.
struct Chain::Parts {
  Problem problem;
  Scheme scheme;
  Sides sides;
  Execution execution;
  Forces forces;
  std::vector<Slab> slabs;
  long level = 0;
  std::size_t depth = halo;  ///< levels between exchanges

  Parts(const Problem& p, const Execution& e, long at);

  void fill(const Levels& levels);
  /// `count` <= depth levels.
  void advance(std::size_t count);
  /// \throws NumericsError
  void check_numbers() const;
  /// z / 2 pi of site j at both levels, also beyond the ends.
  std::pair<double, double> site(long j) const;

 private:
  /// Halos of slab i from its neighbours, around a periodic chain too; across its seam the values are left as they are.
  /// Where a chain is cut over processes this is the place of the messages.
  void exchange(std::size_t i);
  void advance_slab(Slab& slab, std::size_t count);
};

}  // namespace slipfront::chain
