#pragma once

#include <vector>

/// Speeds and averages that follow from the rapidities of all edges at one position. The rapidities rise, and there is
/// an even number of them.
namespace slipfront::pulse::edges {

/// Speed of edge j.
double speed_of(const std::vector<double>& edges, std::size_t j);

/// Averages over all trains at one position; 0 where there are none.
struct Means {
  double k = 0, W = 0, H = 0;
  double trains = 0;  ///< number of trains
};
Means means_of(const std::vector<double>& edges);

}  // namespace slipfront::pulse::edges
