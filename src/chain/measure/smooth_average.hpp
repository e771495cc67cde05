#pragma once

#include "slipfront/chain/chain.hpp"

namespace slipfront::chain {

/// An average that smooths out single dislocations.
struct SmoothAverage {
  double velocity;  ///< u_t
  double stress;    ///< -u_x
  double energy;    ///< u_t^2 / 2 + u_x^2 / 2 + a^2 (1 - cos u)
};

/// (all) Averages around x with the weight 1 + cos(2 pi (x' - x) / width). The window has this width, and is cut at the
/// ends of the chain. `time` may be at most a step away. In a uniform average at a small scale, one dislocation more or
/// less would change the velocity much. With this weight, the ripple of the train falls with the cube of the number of
/// dislocations in the window. \throws InputError for a window without width or outside the chain.
SmoothAverage smooth_average(const Sites& chain, double x, double width, double time);
/// Computes such an average from sites that the caller has already, for many averages at once. \throws InputError
/// unless `sites` extends the window by two sites on either side.
SmoothAverage smooth_average(const Sites& chain, const Window& sites, double x, double width);

/// A smooth average over the best of several windows.
struct BestAverage {
  SmoothAverage average;
  double width;           ///< width of the window
  double velocity_error;  ///< NaN if the chain has room for one width only
  double stress_error;
};

/// (all) Averages around x over windows from `least` to `most` wide, each sqrt(2) times as wide as the one before, and
/// returns the one whose velocity changes least if the window is up to twice as wide or narrow. A narrow window shows
/// how trains that pass through each other beat, a wide one shows the shape of the pulse. The errors are 1.5 times
/// these changes. `time` may be at most a step away. \throws InputError as smooth_average does, for the window `least`.
BestAverage best_average(const Sites& chain, double x, double least, double most, double time);

/// Energy density of the uniform train with this stress and slip velocity. If an average has more energy, the excess is
/// in phonons, or comes from a front in the window. `contact` is a(x): the train is uniform in its local units.
double energy_of_train(double stress, double velocity, double contact = 1);

}  // namespace slipfront::chain
