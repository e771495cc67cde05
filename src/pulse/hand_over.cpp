#include "pulse/hand_over.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "foundation/math/constants.hpp"
#include "foundation/text/digits.hpp"
#include "pulse/contours/along.hpp"
#include "pulse/grid/gaps.hpp"
#include "slipfront/error.hpp"
#include "slipfront/modulation/per_dislocation.hpp"

namespace slipfront::pulse {
namespace {

/// x, and the momentum to the left of it.
struct Face {
  double x, momentum;
};

/// The position with as many dislocations to the left as there were at a face at t = 0. Densities are linear between
/// positions.
Face face_at(const Counted& all, double count) {
  const auto at = std::upper_bound(all.count.begin() + 1, all.count.end() - 1, count) - all.count.begin();
  const auto right = static_cast<std::size_t>(at), left = right - 1;
  const double width = all.x[right] - all.x[left], counted = all.count[right] - all.count[left];
  const double share = counted > 0 ? (count - all.count[left]) / counted : 0;
  const double mean = (all.density[right] + all.density[left]) / 2;
  const double bend = mean > 0 ? (all.density[right] - all.density[left]) / mean / 2 : 0;
  const double slope = 1 - bend, root = std::sqrt(std::fmax(slope * slope + 4 * bend * share, 0));
  const double part = slope + root > 0 ? 2 * share / (slope + root) : share;  // part + bend part (part - 1) = share
  const double momentum_bend = width * (all.momentum_density[right] - all.momentum_density[left]) / 2;
  return {all.x[left] + part * width,
          std::lerp(all.momentum[left], all.momentum[right], part) + momentum_bend * part * (part - 1)};
}

/// The free edge at a face whose cell is to the left of it (side -1) or to the right. If no empty region is left there,
/// it is a face between cells.
Face edge_at(const Counted& all, double count, int side) {
  const std::size_t n = all.x.size();
  std::size_t nearest = n;
  for (std::size_t j = 0; j < n; ++j) {
    const std::size_t i = side < 0 ? n - 1 - j : j, next = side < 0 ? i - 1 : i + 1;  // towards the cell
    const bool ends = all.density[i] == 0 && j + 1 < n && all.density[next] > 0;
    if (ends && (nearest == n || std::fabs(all.count[i] - count) < std::fabs(all.count[nearest] - count))) nearest = i;
  }
  const Face inside = face_at(all, count);
  const bool has_edge =
      nearest < n && std::fabs(all.count[nearest] - count) < 1e-3 * (all.count.back() - all.count.front());
  return has_edge ? Face{all.x[nearest], all.momentum[nearest]} : inside;
}

/// The middle of where dislocations overtake each other; NaN if they do not.
double overtaking(const ManyTrains& trains) {
  double left = none, right = none;
  Sweep(trains.contour()).at_points([&](std::size_t point, const std::vector<double>& edges, std::size_t) {
    if (edges.size() < 4) return;
    right = trains.contour().x[point];
    if (std::isnan(left)) left = right;
  });
  return (left + right) / 2;
}

}  // namespace

Cells cells_of(const ManyTrains& trains, Cells cells) {
  const Counted all = Along(trains).counted(cells.left_edge());
  const std::size_t n = cells.size();
  double count = 0;
  for (std::size_t i = 0; i < n; ++i) {
    const double charge = cells.charge[i];
    const auto is_empty = [&](std::size_t neighbour) { return neighbour >= n || cells.charge[neighbour] == 0; };
    const int towards = charge > 0 ? 1 : -1;  // the cell with dislocations
    const Face left = is_empty(i - 1) || charge == 0 ? edge_at(all, count, towards) : face_at(all, count);
    const Face right =
        is_empty(i + 1) || charge == 0 ? edge_at(all, count + charge, -towards) : face_at(all, count + charge);
    if (i == 0) cells.left_edge() = left.x;
    cells.width(i) = right.x - left.x;
    cells.momentum(i) = right.momentum - left.momentum;
    count += charge;
    if (charge == 0) continue;
    cells.s[i] = std::tanh(
        modulation::state_of({cells.width(i) / charge, cells.momentum(i) / charge}, std::atanh(cells.s[i])).psi);
  }
  const Work& work = trains.work();
  cells.values().dissipated() = work.dissipated;
  cells.values().supplied() = work.supplied;
  cells.values().through_ends() = work.through_ends;
  cells.time = trains.time();
  cells.steps = trains.steps();
  cells.crossing_position = overtaking(trains);
  if (!std::isnan(cells.crossing_position)) cells.crossing_time = cells.time;
  close_gaps(cells);
  return cells;
}

std::unique_ptr<OneTrain> one_train_after(const ManyTrains& trains) {
  output::Findings found = trains.findings_now();
  if (found.wrong_results()) throw NumericsError("t = " + digits(trains.time()) + ": " + found.worst);
  Problem problem = trains.problem();
  problem.many_trains = false;
  const Contour& now = trains.contour();
  OneTrain::Start start{.cells = cells_of(trains, Solver(problem).cells()),
                        .trailing_front = now.front == Contour::nothing ? none : now.x[now.front],
                        .slip = trains.slip(),
                        .warnings = std::move(found.sentences)};
  return std::make_unique<OneTrain>(std::move(problem), std::move(start));
}

}  // namespace slipfront::pulse
