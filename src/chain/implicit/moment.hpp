#pragma once

#include <vector>

#include "chain/events/event_log.hpp"
#include "chain/events/front_log.hpp"

namespace slipfront::chain {

/// The motion between two implicit steps, and everything else that the next step depends on.
struct Moment {
  double time = 0;
  long steps = 0;
  double last_step = 0, earlier_step = 0, next_step = 0;
  double window_start = 0;       ///< time at which the present window of ImplicitChain::check_progress began
  std::vector<double> u, v;      ///< like all columns, of the sites of this rank
  std::vector<double> state;     ///< the friction law's state variables, site by site
  std::vector<double> w, slope;  ///< velocity and slope of friction in the last step
  std::vector<double> acceleration, earlier;  ///< accelerations of the last step and of the step before it
  std::vector<double> excess;                 ///< p - p_0 of the pores; empty unless contacts change
  std::vector<double> a2;                     ///< follows from the state; empty if a is the same everywhere
  /// Energy supplied, dissipated, and given by contacts, block by block: sums that do not depend on the ranks.
  std::vector<double> flows;
  EventLog log;
  FrontLog fronts;
};

/// Calls number(member), and then column(member, whether it has numbers for each site, or else for each block), for the
/// members that a checkpoint stores, in the order of the file. The logs of events and of fronts follow them in the
/// file.
template <class AMoment, class Number, class Column>
void each_saved(AMoment& m, const Number& number, const Column& column) {
  number(m.time);
  number(m.steps);
  for (auto* step : {&m.last_step, &m.earlier_step, &m.next_step}) number(*step);
  number(m.window_start);
  for (auto* values : {&m.u, &m.v, &m.state, &m.w, &m.slope, &m.acceleration, &m.earlier, &m.excess})
    column(*values, true);
  column(m.flows, false);
}

}  // namespace slipfront::chain
