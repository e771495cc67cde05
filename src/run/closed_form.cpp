#include <cmath>
#include <limits>

#include "foundation/math/constants.hpp"
#include "foundation/math/roots.hpp"
#include "run/compare.hpp"
#include "slipfront/output/quantities.hpp"
#include "slipfront/rupture/riemann_trains.hpp"
#include "slipfront/train/train.hpp"

namespace slipfront::run {
namespace {

using rupture::Edges;
using rupture::TrainsSolution;

double velocity(const TrainsSolution& solution, double x_over_t) {
  return rupture::profile_point(solution, x_over_t).all.W;
}
double speed(const TrainsSolution& solution, double x_over_t) { return std::fabs(velocity(solution, x_over_t)); }

/// x/t of the greatest slip velocity. We take the best of many samples, and refine it by golden-section search between
/// its neighbours.
double peak_of(const TrainsSolution& solution, const Edges& edges) {
  constexpr int samples = 2000;
  const double width = edges.right - edges.left;
  const auto place = [&](int i) { return edges.left + width * i / samples; };
  int best = 1;
  double largest = speed(solution, place(best));
  for (int i = 2; i < samples; ++i)
    if (const double here = speed(solution, place(i)); here > largest) {
      best = i;
      largest = here;
    }
  double low = place(best - 1), high = place(best + 1);
  constexpr double golden = 0.6180339887498949;
  for (int i = 0; i < 60; ++i) {
    const double a = high - golden * (high - low), b = low + golden * (high - low);
    if (speed(solution, a) < speed(solution, b))
      low = a;
    else
      high = b;
  }
  return (low + high) / 2;
}

/// x/t between a position at rest and the peak, at which the slip velocity passes `level`. The slip velocity is
/// monotone in each wave.
double passes(const TrainsSolution& solution, double resting, double peak, double level) {
  const auto is_slower = [&](double x_over_t) { return speed(solution, x_over_t) < level; };
  return bisected({.holding = resting, .failing = peak}, is_slower).failing;
}

/// The rays x/t on which fronts and peak move: all states depend on x/t only.
struct Rays {
  double fast, slow;  ///< fronts
  double peak, peak_velocity;
  double fast_observed, slow_observed;  ///< fronts that an observer with a threshold sees
};
Rays rays_of(const TrainsSolution& solution, double threshold) {
  const Edges edges = rupture::edges_of(solution);
  const bool stressed_left = solution.left.psi >= solution.right.psi;
  const double fast = stressed_left ? edges.left : edges.right, slow = stressed_left ? edges.right : edges.left;
  const double peak = peak_of(solution, edges), level = threshold * speed(solution, peak);
  return {.fast = fast,
          .slow = slow,
          .peak = peak,
          .peak_velocity = velocity(solution, peak),
          .fast_observed = passes(solution, fast, peak, level),
          .slow_observed = passes(solution, slow, peak, level)};
}

/// The energies without friction and forcing. Nothing is dissipated or supplied; the other energies are not computed.
output::Energy energy_without_forces() {
  return {.elastic = none,
          .kinetic = none,
          .dissipated = 0,
          .supplied = 0,
          .through_ends = none,
          .shocks = none,
          .residual = none,
          .phonons = none};
}

/// The averages at x. At t = 0 they are those of the given sides.
rupture::TrainsPoint point_at(const TrainsSolution& solution, double x, double time) {
  if (time > 0) return rupture::profile_point(solution, x / time);
  const State& side = x < 0 ? solution.left : solution.right;
  return rupture::profile_point(side.empty() ? rupture::FilledBands{} : rupture::bands_of_train(side));
}

output::Snapshot snapshot_of(const TrainsSolution& solution, const Rays& rays, const output::Schedule& schedule,
                             double time) {
  output::Snapshot s{};
  s.time = time;
  for (std::size_t i = 0; i + 1 < schedule.x_edges.size(); ++i) {
    const rupture::TrainsPoint here = point_at(solution, (schedule.x_edges[i] + schedule.x_edges[i + 1]) / 2, time);
    s.profile.k.push_back(here.all.Sigma);
    s.profile.U.push_back(here.all.U);
    s.profile.W.push_back(here.all.W);
    s.profile.H.push_back(here.H);
    s.profile.slip.push_back(time * here.slip);
  }
  s.energy = energy_without_forces();
  s.fronts = {.trailing = time * rays.fast,
              .leading = time * rays.slow,
              .trailing_characteristic = time * rays.fast,
              .trailing_observed = none,
              .leading_observed = none};
  const rupture::TrainsPoint origin = point_at(solution, 0, time);
  s.slip_velocity_at_origin = origin.all.W;
  s.stress_at_origin = origin.all.Sigma;
  s.slip_at_origin = time * origin.slip;
  output::complete(s, schedule);
  s.peak_position = none;
  if (time > 0) {
    s.peak_slip_velocity = rays.peak_velocity;
    s.peak_position = time * rays.peak;
    s.fronts.trailing_observed = time * rays.fast_observed;
    s.fronts.leading_observed = time * rays.slow_observed;
  }
  return s;
}

}  // namespace

std::optional<Level> closed_form(const scenario::Scenario& s, const output::Schedule& schedule) {
  if (!s.initial.jumps || s.friction.acts() || s.forcing_at || s.contact_at) return {};
  if (s.initial.stress_left == s.initial.stress_right) return {};  // nothing moves, so there is no wave to compare
  const TrainsSolution solution =
      rupture::solve_trains(train::at_rest(s.initial.stress_left), train::at_rest(s.initial.stress_right));
  const Edges edges = rupture::edges_of(solution);
  if (schedule.x_edges.front() > s.end * edges.left || schedule.x_edges.back() < s.end * edges.right) return {};
  const Rays rays = rays_of(solution, schedule.threshold);
  Level level{.name = "closed-form"};
  for (const double time : schedule.times) level.snapshots.push_back(snapshot_of(solution, rays, schedule, time));
  return level;
}

}  // namespace slipfront::run
