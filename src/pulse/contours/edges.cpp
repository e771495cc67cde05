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

/// The bands between these edges. Those that are too narrow are closed.
rupture::FilledBands bands_of(const std::vector<double>& edges) {
  rupture::FilledBands bands = rupture::bands_of_edges(edges);
  for (double& width : bands.widths)
    if (width < no_width) width = 0;
  return bands;
}

}  // namespace

double speed_of(const std::vector<double>& edges, std::size_t j) {
  if (edges.size() == 2) {
    const modulation::Speeds speeds = modulation::characteristic_speeds(train_between(edges[0], edges[1]));
    return j == 0 ? speeds.minus : speeds.plus;
  }
  return rupture::edge_speeds(bands_of(edges))[j];
}

Source source_of(std::vector<double> edges, std::size_t j, const Forces& forces) {
  if (!forces.act()) return {};
  Source result;
  while (edges.size() > 4) {
    std::size_t least = edges.size();
    for (std::size_t i = 0; i + 1 < edges.size(); ++i) {
      if (edges[i] == edges[j] || edges[i + 1] == edges[j]) continue;
      if (least == edges.size() || edges[i + 1] - edges[i] < edges[least + 1] - edges[least]) least = i;
    }
    if (least == edges.size()) least = j + 2;  // all are next to edge j, which is there more than twice
    const double width = edges[least + 1] - edges[least];
    result.left_out = std::fmax(result.left_out, width / (edges.back() - edges.front()));
    const auto at = edges.begin() + static_cast<std::ptrdiff_t>(least);
    edges.erase(at, at + 2);
    if (least < j) j -= 2;
  }
  const std::vector<double> all = rupture::edge_sources(bands_of(edges), forces.load, forces.viscosity);
  result.change = j + 1 < edges.size() && edges[j + 1] == edges[j] ? (all[j] + all[j + 1]) / 2 : all[j];
  return result;
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
    return {one.k, one.W, one.P, one.H, one.k > 0 ? one.W / one.k * one.P : 0, trains};  // <u_t^2> = U P
  }
  const rupture::BandAverages all = rupture::averages(rupture::bands_of_edges(open));
  return {all.k, all.W, all.P, all.H, all.squared_rate, trains};
}

}  // namespace slipfront::pulse::edges
