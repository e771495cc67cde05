#include "pulse/contours/edges.hpp"

#include <cmath>

#include "slipfront/modulation/characteristics.hpp"
#include "slipfront/rupture/trains.hpp"
#include "slipfront/train/train.hpp"

namespace slipfront::pulse::edges {
namespace {

/// Widths below this are none: the averages do not exist for smaller ones.
constexpr double no_width = 1e-300;

State train_between(double low, double high) { return {low + (high - low) / 2, (high - low) / 2}; }

}  // namespace

double speed_of(const std::vector<double>& edges, std::size_t j) {
  if (edges.size() == 2) {
    const modulation::Speeds speeds = modulation::characteristic_speeds(train_between(edges[0], edges[1]));
    return j == 0 ? speeds.minus : speeds.plus;
  }
  rupture::FilledBands bands = rupture::bands_of_edges(edges);
  for (double& width : bands.widths)
    if (width < no_width) width = 0;
  return rupture::edge_speeds(bands)[j];
}

Means means_of(const std::vector<double>& edges) {
  std::vector<double> open;  // without bands and gaps that have no width
  for (const double r : edges) {
    const bool same = !open.empty() && r - open.back() < no_width;
    same ? open.pop_back() : open.push_back(r);
  }
  const std::size_t bands = open.size() / 2;
  const auto trains = static_cast<double>(bands);
  if (open.empty()) return {};
  if (open.size() == 2) {
    const train::Averages one = train::averages(train_between(open[0], open[1]));
    return {one.k, one.W, one.H, trains};
  }
  const rupture::BandAverages all = rupture::averages(rupture::bands_of_edges(open));
  return {all.k, all.W, all.H, trains};
}

}  // namespace slipfront::pulse::edges
