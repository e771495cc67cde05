#pragma once
/// \file
/// The dislocation lines of a state of all sites: the contours u = pi, 3 pi, 5 pi, ...

#include <vector>

#include "lattice/plane/direct/sites.hpp"

namespace slipfront::plane {

/// The lines of the stretched displacement `u`, as marching squares with linear interpolation between sites.
/// Every so many crossings between sites become a point: by default every third, because crossings are about a third of
/// a width apart.
std::vector<Line> lines_of(const std::vector<double>& u, const Sites& sites, int crossings_a_point = 3);

}  // namespace slipfront::plane
