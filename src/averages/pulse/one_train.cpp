#include "averages/pulse/one_train.hpp"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "averages/pulse/checks/checks.hpp"
#include "averages/pulse/contours/sweep.hpp"
#include "averages/pulse/grid/layout.hpp"
#include "averages/pulse/observe/observe.hpp"
#include "math/constants.hpp"
#include "math/digits.hpp"
#include "slipfront/error.hpp"
#include "slipfront/theory/modulation/modulation.hpp"

namespace slipfront::pulse {

OneTrain::OneTrain(Problem problem)
    : solver_(std::move(problem)), trailing_characteristic_(solver_), first_energy_(stored_energy(solver_)) {}

OneTrain::OneTrain(Problem problem, Start start) : OneTrain(std::move(problem)) {
  const double trailing = std::isnan(start.trailing_front) ? trailing_characteristic_.position() : start.trailing_front;
  solver_.restore(std::move(start.cells));
  trailing_characteristic_.restore(solver_, trailing);
  slip_ = start.slip;
  warnings_ = std::move(start.warnings);
}

bool OneTrain::advance_to(double target, const std::function<bool()>& after_step) {
  double before = time();
  return solver_.advance_to(target, [&] {
    const Cells& cells = solver_.cells();
    trailing_characteristic_.advance(solver_, cells.time - before);
    before = cells.time;
    // We sample implicit steps more often: one costs as much as ten samples, an explicit step only as much as a few.
    const bool begins = cells.steps < 64, is_explicit = cells.face_momentum.empty();
    if (cells.steps % (is_explicit ? begins ? 4 : 16 : begins ? 1 : 2) == 0) slip_.sample(solver_);
    return after_step();
  });
}

void OneTrain::archive(Archive& a) {
  double position = trailing_characteristic_.position();
  a(solver_, position, slip_, warnings_);
  if (a.reads()) trailing_characteristic_.restore(solver_, position);
}

output::Snapshot OneTrain::observe(const output::Schedule& schedule) const {
  output::Snapshot s = pulse::observe(solver_, schedule.x_edges, trailing_characteristic_, schedule.threshold);
  const StoredEnergy stored = stored_energy(solver_);
  output::Energy& e = s.energy;
  const double released =
      (first_energy_.isolated - stored.isolated + e.through_ends) + first_energy_.interaction - stored.interaction;
  e.residual = released + first_energy_.kinetic + e.supplied - e.dissipated - e.kinetic;
  if (!std::isnan(crossing_time())) e.shocks = e.residual;
  return s;
}

output::Findings OneTrain::findings(const std::vector<output::Snapshot>& snapshots) const {
  output::Findings found = Checks(solver_, first_energy_, slip_, snapshots).findings();
  found.sentences.insert(found.sentences.end(), warnings_.begin(), warnings_.end());
  return found;
}

namespace {

/// x, and the momentum to the left of it.
struct Face {
  double x, momentum;
};

/// The position with `count` dislocations to the left. Densities are linear between positions.
Face face_at(const Counted& all, double count) {
  const auto at = std::upper_bound(all.now.begin() + 1, all.now.end() - 1, count) - all.now.begin();
  const auto right = static_cast<std::size_t>(at), left = right - 1;
  const double width = all.x[right] - all.x[left], counted = all.now[right] - all.now[left];
  const double share = counted > 0 ? (count - all.now[left]) / counted : 0;
  const double mean = (all.density[right] + all.density[left]) / 2;
  const double bend = mean > 0 ? (all.density[right] - all.density[left]) / mean / 2 : 0;
  const double slope = 1 - bend, root = std::sqrt(std::fmax(slope * slope + 4 * bend * share, 0));
  const double part = slope + root > 0 ? 2 * share / (slope + root) : share;  // part + bend part (part - 1) = share
  const double momentum_bend = width * (all.momentum_density[right] - all.momentum_density[left]) / 2;
  return {all.x[left] + part * width,
          std::lerp(all.momentum[left], all.momentum[right], part) + momentum_bend * part * (part - 1)};
}

/// The free edge at a face whose cell is to the left of it, or to the right. If no empty region is left there, it is a
/// face between cells.
Face edge_at(const Counted& all, double count, bool cell_is_left) {
  double nearest = 1e-3 * (all.now.back() - all.now.front());
  Face edge = face_at(all, count);
  for (std::size_t i = 0; i + 1 < all.x.size(); ++i) {
    const std::size_t in_cell = cell_is_left ? i : i + 1, outside = cell_is_left ? i + 1 : i;
    if (!(all.density[outside] == 0 && all.density[in_cell] > 0)) continue;
    if (std::fabs(all.now[outside] - count) >= nearest) continue;
    nearest = std::fabs(all.now[outside] - count);
    edge = {all.x[outside], all.momentum[outside]};
  }
  return edge;
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
  const std::size_t n = cells.size();
  std::vector<double> faces{cells.left_edge()};
  for (std::size_t i = 0; i < n; ++i) faces.push_back(faces.back() + cells.width(i));
  const Counted all = Along(trains, faces).counted();
  const auto is_empty = [&](std::size_t i) { return i >= n || cells.charge[i] == 0; };
  // The face behind cell i - 1 and before cell i. As many dislocations are to the left as there were at t = 0.
  const auto face = [&](std::size_t i) {
    const auto at = std::lower_bound(all.x.begin(), all.x.end(), faces[i]) - all.x.begin();
    const double count = all.first[static_cast<std::size_t>(at)];
    const bool left = i > 0 && !is_empty(i - 1), right = !is_empty(i);
    return left && right ? face_at(all, count) : edge_at(all, count, left);
  };
  Face left = face(0);
  cells.left_edge() = left.x;
  for (std::size_t i = 0; i < n; ++i) {
    const Face right = face(i + 1);
    const double charge = cells.charge[i];
    cells.width(i) = right.x - left.x;
    cells.momentum(i) = right.momentum - left.momentum;
    left = right;
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

std::unique_ptr<OneTrain> one_train_after(const ManyTrains& trains, const output::Schedule& schedule) {
  output::Findings found = trains.findings({trains.observe(schedule)});
  if (const std::string third = trains.third_train(); !third.empty()) found.sentences.push_back(third);
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
