#include <cmath>
#include <limits>

#include "foundation/math/constants.hpp"
#include "foundation/math/roots.hpp"
#include "output/further_scalars.hpp"
#include "slipfront/rupture/riemann_trains.hpp"
#include "slipfront/setup/compare.hpp"
#include "slipfront/train/train.hpp"

namespace slipfront::setup {
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
  for (int i = 2; i < samples; ++i)
    if (speed(solution, place(i)) > speed(solution, place(best))) best = i;
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

/// Adds the values without a closed form: the peak of the slip velocity, and the fronts that an observer with a
/// threshold sees. `fast` and `slow` are x/t of the fronts.
void add_observed(output::Snapshot& s, const TrainsSolution& solution, double threshold, double fast, double slow) {
  const double peak = peak_of(solution, rupture::edges_of(solution)), most = speed(solution, peak);
  s.peak_slip_velocity = velocity(solution, peak);
  s.peak_position = s.time * peak;
  s.fronts.trailing_observed = s.time * passes(solution, fast, peak, threshold * most);
  s.fronts.leading_observed = s.time * passes(solution, slow, peak, threshold * most);
}

/// The energies without friction and forcing. Nothing is dissipated or supplied; the other energies are not computed.
output::Energy energy_without_forces() {
  return {.elastic = none,
          .kinetic = none,
          .dissipated = 0,
          .supplied = 0,
          .through_ends = none,
          .shocks = none,
          .phonons = none};
}

output::Snapshot snapshot_of(const TrainsSolution& solution, const output::Schedule& schedule, double time) {
  output::Snapshot s{};
  s.time = time;
  const auto bands = [&](double x) {
    if (time > 0) return rupture::bands_at(solution, x / time);
    const State& side = x < 0 ? solution.left : solution.right;
    return side.empty() ? rupture::FilledBands{} : rupture::bands_of_train(side);
  };
  const auto slip = [&](double x) { return time > 0 ? time * rupture::profile_point(solution, x / time).slip : 0; };
  for (std::size_t i = 0; i + 1 < schedule.x_edges.size(); ++i) {
    const double x = (schedule.x_edges[i] + schedule.x_edges[i + 1]) / 2;
    const rupture::FilledBands here = bands(x);
    const rupture::ProfilePoint point = rupture::profile_point(here).all;
    s.profile.k.push_back(point.Sigma);
    s.profile.U.push_back(point.U);
    s.profile.W.push_back(point.W);
    s.profile.H.push_back(here.widths.empty() ? 0 : rupture::averages(here).H);
    s.profile.slip.push_back(slip(x));
  }
  const Edges edges = rupture::edges_of(solution);
  s.energy = energy_without_forces();
  const bool stressed_left = solution.left.psi >= solution.right.psi;
  const double fast = stressed_left ? edges.left : edges.right, slow = stressed_left ? edges.right : edges.left;
  s.fronts = {.trailing = time * fast,
              .leading = time * slow,
              .trailing_characteristic = time * fast,
              .trailing_observed = none,
              .leading_observed = none};
  const rupture::ProfilePoint origin = rupture::profile_point(bands(0)).all;
  s.slip_velocity_at_origin = origin.W;
  s.stress_at_origin = origin.Sigma;
  s.slip_at_origin = slip(0);
  output::add_further_scalars(s, schedule);
  s.peak_position = none;
  if (time > 0) add_observed(s, solution, schedule.threshold, fast, slow);
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
  Level level{.name = "closed-form"};
  for (const double time : schedule.times) level.snapshots.push_back(snapshot_of(solution, schedule, time));
  return level;
}

}  // namespace slipfront::setup
