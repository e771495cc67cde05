#pragma once
/// \file
/// Source parameters of a rupture on a plane, as seismology defines them: duration, corner frequency, spectrum, rupture
/// velocity, rise time, stress before and after, stress drop, and the distance at which the front stops.

#include <cstddef>
#include <vector>

#include "slipfront/lattice/plane/run.hpp"

namespace slipfront::plane {

/// The grid of a map, in the coordinates of the results.
struct MapGrid {
  int nx = 0, ny = 0;
  double dx = 1, dy = 1;  ///< sizes of a cell
  std::size_t at(int i, int j) const {
    return static_cast<std::size_t>(j) * static_cast<std::size_t>(nx) + static_cast<std::size_t>(i);
  }
};
MapGrid grid_of(const Problem& problem, const Schedule& schedule);

/// Speed of the rupture front in each cell, 1 / |gradient of the rupture time|, in c. NaN where the cell or a
/// neighbour has not ruptured, or where all rupture at once.
std::vector<double> rupture_velocity(const MapGrid& grid, const std::vector<double>& rupture_time);

/// Rise time of each cell: slip^2 / integral of the slip velocity squared. For a constant slip velocity it is the
/// duration of slip. NaN where there is no slip.
std::vector<double> rise_time(const std::vector<double>& slip, const std::vector<double>& velocity_squared);

/// Size of the gradient of the mean slip, which is the shear stress in the unit mu A / pi. At the edge of the grid the
/// differences are one-sided.
std::vector<double> stress(const MapGrid& grid, const std::vector<double>& mean_slip);

/// Mean of the stress drop over the plane, weighted by the size of the slip (Noda and Lapusta, 2013, Geophys. J. Int.
/// 193). NaN without slip.
double stress_drop(const std::vector<double>& before, const std::vector<double>& after,
                   const std::vector<double>& slip);

/// Time in which the potency grows from 5 % to 95 % of its largest value, of either sign. NaN without potency.
double duration(const std::vector<SeriesRow>& series);

/// Whether the slip has ended: the potency rate at the end is below 5 % of its largest value.
bool has_ended(const std::vector<SeriesRow>& series);

/// Corner frequency of the moment rate R, sqrt(<R'^2> / <R^2>) / (2 pi), where <> is an integral over time (Andrews,
/// 1986). For a spectrum 1 / (1 + (f / f_c)^2) it is f_c. NaN if the slip has not ended.
double corner_frequency(const std::vector<SeriesRow>& series);

/// Amplitude spectrum of the potency rate at each frequency: its limit at frequency 0 is the potency.
std::vector<double> spectrum(const std::vector<SeriesRow>& series, const std::vector<double>& frequencies);
/// Frequencies of the spectrum: equal ratios, from a tenth of 1 / (duration of the series) to one per two rows.
std::vector<double> spectrum_frequencies(const std::vector<SeriesRow>& series);

/// Distance at which the front has stopped: its largest distance from the origin, if the front came within a thousandth
/// of it before the last tenth of the run. NaN otherwise.
double arrest_radius(const std::vector<SeriesRow>& series);

}  // namespace slipfront::plane
