#pragma once

#include <cstddef>
#include <functional>
#include <vector>

namespace slipfront::chain {

/// All that an explicit chain needs to continue, to the same bits: two levels of z / 2 pi (docs/chain.md), and the
/// state of friction if it has any.
struct Levels {
  long level = 0;  ///< steps done
  std::vector<double> now, before;
  /// The friction law's state variables, site by site, and those of contacts that change (state_names in
  /// contact_field.hpp). Empty at a start.
  std::vector<double> state = {};
};

/// The levels of sites [begin, end), for chains that no process holds whole.
using LevelsOf = std::function<Levels(std::size_t begin, std::size_t end)>;

}  // namespace slipfront::chain
