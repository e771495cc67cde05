#pragma once

#include <cmath>
#include <vector>

#include "chain/events/event_log.hpp"
#include "chain/events/front_log.hpp"
#include "chain/model/blocks.hpp"

namespace slipfront::chain {

/// The motion between two implicit steps, and everything else that the next step depends on.
struct Moment {
  double time = 0;
  long steps = 0;
  double last_step = 0, earlier_step = 0, next_step = 0;
  double window_start = 0;       ///< time at which the present window of ImplicitChain::check_progress began
  std::vector<double> u, v;      ///< like all columns, of the sites of this rank
  std::vector<double> state;     ///< the friction law's state variables, site by site
  std::vector<double> w, slope;  ///< velocity (0 of a held site) and slope of friction in the last step
  std::vector<double> acceleration, earlier;  ///< accelerations of the last step and of the step before it
  std::vector<double> excess;                 ///< p - p_0 of the pores; empty unless contacts change
  std::vector<double> a2;                     ///< follows from the state; empty if a is the same everywhere
  /// Energy supplied, dissipated, and given by contacts, block by block: sums that do not depend on the ranks.
  std::vector<double> flows;
  EventLog log;
  FrontLog fronts;

  /// Visits all members but a2. If `a` writes, all ranks have to call this.
  void archive(Archive& a, const OwnBlocks& own, const Ranks& ranks) {
    a(time, steps, last_step, earlier_step, next_step, window_start);
    for (const double number : {time, last_step, earlier_step, next_step, window_start})
      a.require(std::isfinite(number));
    a.require(steps >= 0);
    for (auto* column : {&u, &v, &state, &w, &slope, &acceleration, &earlier, &excess})
      a.parts(*column, ranks, own.begin, own.size(), own.blocks.sites);
    a.parts(flows, ranks, own.first, own.count, own.blocks.count);
    a(log, fronts);
  }
};

}  // namespace slipfront::chain
