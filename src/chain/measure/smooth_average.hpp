#pragma once

#include "slipfront/chain/chain.hpp"

namespace slipfront::chain {

/// An average in which single dislocations do not show.
struct SmoothAverage {
  double velocity;  ///< u_t
  double stress;    ///< -u_x
  double energy;    ///< u_t^2 / 2 + u_x^2 / 2 + a^2 (1 - cos u)
};

/// Averages around x with the weight 1 + cos(2 pi (x' - x) / width) over a window of that width, or what of it lies on
/// the chain; at `time`, no more than a step away. In a box, a dislocation more or less is all the velocity at small
/// scales; with this weight what is left of the train's ripple falls as the cube of the dislocations in the window.
/// \throws InputError for a window of no width or none of it on the chain.
SmoothAverage smooth_average(const Sites& chain, double x, double width, double time);
/// The same of sites that have been looked at already, for many averages at once; two more on either side are needed.
/// \throws InputError where `sites` do not hold those.
SmoothAverage smooth_average(const Sites& chain, const Window& sites, double x, double width);

/// Energy density of the uniform train of this stress and slip velocity: what H of an average exceeds it by is in
/// phonons (or, in a window with a front in it, in what the window makes even).
/// `contact` is a(x) there: the train is that of theory in its local units.
double energy_of_train(double stress, double velocity, double contact = 1);

}  // namespace slipfront::chain
