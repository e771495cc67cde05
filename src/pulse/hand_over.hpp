#pragma once
/// \file
/// One train at each position takes over from many (docs/theory/9_trains.md 9.7).

#include <memory>

#include "pulse/contours/many_trains.hpp"
#include "pulse/one_train.hpp"

namespace slipfront::pulse {

/// Cells with the dislocations and the momentum of many trains. `cells` are those of the same problem at t = 0.
Cells cells_of(const ManyTrains& trains, Cells cells);

/// The motion that continues from a motion that is over, in a run with this schedule. \throws NumericsError if that has
/// wrong results.
std::unique_ptr<OneTrain> one_train_after(const ManyTrains& trains, const output::Schedule& schedule);

}  // namespace slipfront::pulse
