#pragma once

#include "slipfront/chain/chain.hpp"

namespace slipfront::chain {

/// An average in which single dislocations do not show.
struct SmoothAverage {
  double velocity;  ///< u_t
  double stress;    ///< -u_x
  double energy;    ///< u_t^2 / 2 + u_x^2 / 2 + a^2 (1 - cos u)
};

/// (all) Averages around x with the weight 1 + cos(2 pi (x' - x) / width) over a window of that width, cut at the ends
/// of the chain; at `time`, no more than a step away. In a box, a single dislocation more or less would decide the
/// velocity at small scales. With this weight the remaining ripple of the train falls as the cube of the number of
/// dislocations in the window. \throws InputError for a window of no width, or outside the chain.
SmoothAverage smooth_average(const Sites& chain, double x, double width, double time);
/// The same from a window that a caller has, for many averages at once. It has two more sites on either side.
/// \throws InputError otherwise.
SmoothAverage smooth_average(const Sites& chain, const Window& sites, double x, double width);

/// Energy density of the uniform train of this stress and slip velocity. The excess of an average's energy over it is
/// in phonons, or comes from a front in the window. `contact` is a(x) there: the train is uniform in its local units.
double energy_of_train(double stress, double velocity, double contact = 1);

}  // namespace slipfront::chain
