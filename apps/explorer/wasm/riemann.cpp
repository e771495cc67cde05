/// \file
/// Panel "Riemann": two uniform trains meet at x = 0. The solution is exact, with two trains where dislocations
/// overtake each other.

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "answer.hpp"
#include "slipfront/error.hpp"
#include "slipfront/theory/rupture/riemann_trains.hpp"
#include "slipfront/theory/train.hpp"

namespace slipfront::explorer {
namespace {

using rupture::TrainsSolution;
using rupture::Wave;

Object described(const Wave& wave) {
  return Object().put("kind", rupture::name_of(wave.kind)).put("outer", wave.outer).put("inner", wave.inner);
}

std::vector<Object> described(const std::vector<rupture::Region>& regions) {
  std::vector<Object> all;
  for (const rupture::Region& region : regions)
    all.push_back(Object()
                      .put("kind", rupture::name_of(region.kind))
                      .put("from", region.from)
                      .put("to", region.to)
                      .put("trains", static_cast<int>(region.trains)));
  return all;
}

/// Evenly spaced x/t around the waves, and both sides of each edge of a region, where curves bend or jump.
std::vector<double> positions(const TrainsSolution& solution, const rupture::Edges& edges, int points) {
  const double width = std::max(edges.right - edges.left, 1e-12);
  std::vector<double> x;
  for (int i = 0; i < points; ++i) x.push_back(edges.left - 0.25 * width + 1.5 * width * i / (points - 1));
  for (const rupture::Region& region : solution.regions)
    for (const double edge : {region.from, region.to})
      for (const double side : {-1e-9, 1e-9}) x.push_back(edge + side * width);
  std::sort(x.begin(), x.end());
  return x;
}

/// Profiles of the averages over x/t, and the rapidities of the edges of each train.
void put_profiles(Object& object, const TrainsSolution& solution, const std::vector<double>& x) {
  std::vector<double> Sigma, W, slip;
  std::array<std::vector<double>, 4> edges;
  for (const double at : x) {
    const rupture::TrainsPoint point = rupture::profile_point(solution, at);
    Sigma.push_back(point.all.Sigma);
    W.push_back(point.all.W);
    slip.push_back(point.slip);
    for (std::size_t i = 0; i < edges.size() / 2; ++i) {
      const bool here = i < point.trains.size();
      constexpr double none = std::numeric_limits<double>::quiet_NaN();
      edges[2 * i].push_back(here ? point.trains[i].lowest : none);
      edges[2 * i + 1].push_back(here ? point.trains[i].highest : none);
    }
  }
  object.numbers("x_over_t", x).numbers("Sigma", Sigma).numbers("W", W).numbers("slip", slip);
  object.numbers("lowest_1", edges[0]).numbers("highest_1", edges[1]).numbers("lowest_2", edges[2]);
  object.numbers("highest_2", edges[3]);
}

}  // namespace

SLIPFRONT_EXPORT const char* riemann(double left_stress, double left_velocity, double right_stress,
                                     double right_velocity, int points) {
  return answer([=] {
    const State left = rupture::moving_train(left_stress, left_velocity, "left");
    const State right = rupture::moving_train(right_stress, right_velocity, "right");
    if (left.empty() && right.empty())
      throw InputError({.key = "left_stress", .problem = "both sides are empty", .allowed = "a stress on one side"});
    const TrainsSolution solution = rupture::solve_trains(left, right);
    const rupture::Edges edges = rupture::edges_of(solution);
    const rupture::TrainsPoint between = rupture::profile_point(solution.star);
    Object object;
    object.put("left_wave", described(solution.left_wave)).put("right_wave", described(solution.right_wave));
    object.put("regions", described(solution.regions));
    object.put("Sigma_between", between.all.Sigma).put("W_between", between.all.W);
    object.put("trains_between", static_cast<int>(between.trains.size()));
    object.put("left_edge", edges.left).put("right_edge", edges.right);
    put_profiles(object, solution, positions(solution, edges, std::clamp(points, 2, 20000)));
    return object;
  });
}

}  // namespace slipfront::explorer
