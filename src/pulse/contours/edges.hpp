#pragma once

#include <vector>

/// Speeds and averages that follow from the rapidities of all edges at one position. The rapidities rise, and there is
/// an even number of them.
namespace slipfront::pulse::edges {

/// Speed of edge j.
double speed_of(const std::vector<double>& edges, std::size_t j);

/// Load F and viscosity C at one position.
struct Forces {
  double load = 0, viscosity = 0;
  bool act() const { return load != 0 || viscosity != 0; }
};
/// Change of the rapidity of edge j with time, Eq. (9.11). Two edges that are equal change as one. Of three or more
/// trains, the narrowest bands and gaps of other edges are left out.
struct Source {
  double change = 0;
  double left_out = 0;  ///< greatest width that is left out, over the range of all edges
};
Source source_of(std::vector<double> edges, std::size_t j, const Forces& forces);

/// Averages over all trains at one position; 0 where there are none.
struct Means {
  double k = 0, W = 0, P = 0, H = 0;
  double squared_rate = 0;  ///< <u_t^2>
  double trains = 0;        ///< number of trains
};
Means means_of(const std::vector<double>& edges);

}  // namespace slipfront::pulse::edges
