#pragma once

#include <algorithm>
#include <cstddef>
#include <span>
#include <vector>

#include "lattice/chain/model/blocks.hpp"
#include "slipfront/lattice/chain/chain.hpp"
#include "slipfront/lattice/chain/problem.hpp"
#include "slipfront/text/output/snapshot.hpp"
#include "system/ranks.hpp"

namespace slipfront::chain {

using output::Dislocation;

/// (all) All dislocations at `time` (Sites::window), from left to right; sixth-order interpolation between sites.
std::vector<Dislocation> dislocations(const Sites& chain, double time);
std::vector<Dislocation> dislocations(const Sites& chain);

/// (all) u of all sites at `time`. Only rank 0 gets them.
std::vector<double> displacements(const Sites& chain, double time);

/// u / 2 pi - 1/2. Where it passes a whole number, there is a dislocation.
double level_of(double u);

/// (all) The dislocations between site j and the next, which around a ring may be the first.
std::vector<Dislocation> dislocations_after(const Sites& chain, std::size_t j, double time);

/// (all) Calls measure(window, begin, end) for each block of this rank, in order. The window has its sites [begin, end)
/// at `time`, and `more` sites on either side, or as many as the chain has there.
template <class Measure>
void for_own_blocks(const Sites& chain, std::size_t more, double time, const Measure& measure) {
  constexpr std::size_t most = 2048;  // sites of a window, which stay in the cache, or one block
  const Ranks& ranks = chain.ranks();
  const Blocks blocks{chain.problem().grid.sites};
  const std::size_t end = blocks.first_of(ranks.rank() + 1, ranks.size());
  chain.exchange();
  for (std::size_t block = blocks.first_of(ranks.rank(), ranks.size()); block < end;) {
    const std::size_t first = blocks.begin(block);
    std::size_t after = block + 1;
    while (after < end && blocks.begin(after + 1) - first <= most) ++after;
    const Window window =
        chain.own_window(first < more ? 0 : first - more, std::min(blocks.begin(after) + more, blocks.sites), time);
    for (; block < after; ++block) measure(window, blocks.begin(block), blocks.begin(block + 1));
  }
}

/// Lagrange interpolation of v through the (up to) six sites around r (counted in sites of v).
double interpolated(std::span<const double> v, double r);

/// A mean over some sites: the sum of weights times values at sites from `begin` on.
struct SiteWeights {
  std::size_t begin = 0;
  std::vector<double> weights = {};

  std::size_t end() const { return begin + weights.size(); }
  double operator()(std::span<const double> values) const;
};

/// The mean of the interpolant over [x - width / 2, x + width / 2]. \throws InputError for a window outside the chain
/// or of no width.
SiteWeights weights_of_mean(const Grid& grid, double x, double width);
/// The mean with the weight 1 + cos(2 pi (x' - x) / width), over the part of such a window that is on the chain.
/// \throws InputError for a window without width or outside the chain.
SiteWeights weights_of_smooth_mean(const Grid& grid, double x, double width);

/// \throws InputError: a window that is not on the chain, or has no width.
[[noreturn]] void refuse_window(const Grid& grid, double x, double width);

/// Averages over [x - width / 2, x + width / 2].
struct Average {
  double x, width;  ///< the window
  double u;         ///< displacement; slip is its increase since t = 0
  double velocity;  ///< u_t
  double stress;    ///< -u_x, from the displacements at the ends of the window
};

/// (all) At `time`, no more than a step away. The window should hold whole spacings 2 pi / k of the train; else one
/// dislocation more or less shows. \throws InputError for a window outside the chain or of no width.
Average average(const Sites& chain, double x, double width, double time);
/// (all) Only the displacement of such an average, in less time.
double average_displacement(const Sites& chain, double x, double width, double time);
double average_displacement(const Sites& chain, const SiteWeights& mean, double time);

/// An average that smooths out single dislocations.
struct SmoothAverage {
  double velocity;  ///< u_t
  double stress;    ///< -u_x
  double energy;    ///< u_t^2 / 2 + u_x^2 / 2 + a^2 (1 - cos u)
};

/// The energy density u_t^2 / 2 + u_x^2 / 2 + a^2 (1 - cos u) at site j, one of a window that has two more on either
/// side as far as there are sites.
double energy_density(const Problem& problem, const Window& sites, std::size_t j);

/// (all) Averages around x with the weight 1 + cos(2 pi (x' - x) / width). The window has this width, and is cut at the
/// ends of the chain. `time` may be at most a step away. In a uniform average at a small scale, one dislocation more or
/// less would change the velocity much. With this weight, the ripple of the train falls with the cube of the number of
/// dislocations in the window. \throws InputError for a window without width or outside the chain.
SmoothAverage smooth_average(const Sites& chain, double x, double width, double time);
SmoothAverage smooth_average(const Sites& chain, const SiteWeights& mean, double time);
/// Computes such an average from sites that the caller has already, for many averages at once. \throws InputError
/// unless `sites` extends the window by two sites on either side.
SmoothAverage smooth_average(const Sites& chain, const Window& sites, const SiteWeights& mean);

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
