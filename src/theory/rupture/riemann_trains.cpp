#include "slipfront/theory/rupture/riemann_trains.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <utility>

#include "math/digits.hpp"
#include "math/roots.hpp"
#include "slipfront/error.hpp"
#include "slipfront/theory/modulation/modulation.hpp"
#include "slipfront/theory/rupture/relations.hpp"
#include "theory/rupture/inverse.hpp"

// Edges of the bands on both sides: a = phi - psi and b = phi + psi. The wave of the upper edge takes b_left to b_right
// with a_right present, that of the lower edge a_left to a_right with b_left present. Between them is [a_right,
// b_left]. We compute with differences of edges, which slow trains need.

namespace slipfront::rupture {
namespace {

/// The differences of the edges of both sides.
struct EdgeDifferences {
  EdgeDifferences(const State& left, const State& right)
      : lower((left.phi - right.phi) - (left.psi - right.psi)),
        upper((left.phi - right.phi) + (left.psi - right.psi)),
        outer((left.phi - right.phi) + (left.psi + right.psi)),
        inner((left.phi - right.phi) - (left.psi + right.psi)),
        left_width(2 * left.psi),
        right_width(2 * right.psi),
        centre((left.phi + right.phi) / 2 + (left.psi - right.psi) / 2) {}
  double lower;  ///< a_left - a_right
  double upper;  ///< b_left - b_right
  double outer;  ///< b_left - a_right: positive if the trains meet
  double inner;  ///< a_left - b_right: positive if they pass through each other
  double left_width, right_width;
  double centre;  ///< (a_right + b_left) / 2

  /// The largest width of the band whose inner edge moves, in each wave with two trains.
  double widest_lower() const { return std::fmin(lower, right_width); }
  double widest_upper() const { return std::fmin(upper, left_width); }
  /// The trains in these waves. The band with the moving edge has this width.
  FilledBands in_lower(double width) const { return {centre, {width, lower - width, left_width}}; }
  FilledBands in_upper(double width) const { return {centre, {right_width, upper - width, width}}; }
};

double speed_in_lower(const EdgeDifferences& edges, double width) { return edge_speeds(edges.in_lower(width))[1]; }
double speed_in_upper(const EdgeDifferences& edges, double width) { return edge_speeds(edges.in_upper(width))[2]; }

/// Removes bands and gaps that have no width.
FilledBands without_empty(const FilledBands& bands) {
  if (bands.widths.size() != 3) return bands;
  const double low = bands.widths[0], gap = bands.widths[1], high = bands.widths[2];
  if (low > 0 && gap > 0 && high > 0) return bands;
  if (gap <= 0) return {bands.centre, {low + gap + high}};
  if (low <= 0) return {bands.centre + (gap + low) / 2, {high}};
  return {bands.centre - (gap + high) / 2, {low}};
}

FilledBands bands_or_none(const State& state) { return state.empty() ? FilledBands{} : bands_of_train(state); }

void check_side(const State& state, const char* side) {
  constexpr double widest_psi = 20, fastest_phi = 18;
  const auto refuse = [&](double value, const char* key, double least, double most) {
    return InputError({.key = std::string(side) + key,
                       .value = digits(value),
                       .problem = "not a train that the Riemann problem can be solved for",
                       .allowed = digits(least) + " ... " + digits(most)});
  };
  if (!(state.psi >= 0 && state.psi <= widest_psi)) throw refuse(state.psi, " psi", 0, widest_psi);
  if (!state.empty() && !(std::fabs(state.phi) <= fastest_phi))
    throw refuse(state.phi, " phi", -fastest_phi, fastest_phi);
}

Wave fan_wave(double outer, double inner) { return {Wave::Kind::fan, outer, inner}; }

/// The search for a width of a band ends at this part of the widest.
constexpr double narrowest = 1e-17;

}  // namespace

std::string_view name_of(Region::Kind kind) {
  switch (kind) {
    case Region::Kind::constant:
      return "constant";
    case Region::Kind::fan:
      return "fan";
    case Region::Kind::two_trains:
      return "two-trains";
    case Region::Kind::vacuum:
      return "vacuum";
  }
  return "";
}

namespace {

void add_region(TrainsSolution& s, Region::Kind kind, double from, double to, std::size_t trains) {
  if (from < to) s.regions.push_back({kind, from, to, trains});
}

void add_region(TrainsSolution& s, const Wave& wave) {
  const auto [from, to] = std::minmax(wave.outer, wave.inner);
  if (wave.kind == Wave::Kind::fan) add_region(s, Region::Kind::fan, from, to, 1);
  if (wave.kind == Wave::Kind::two_trains) add_region(s, Region::Kind::two_trains, from, to, 2);
}

/// The solution if the trains do not meet: a fan on each side that has a train, and a vacuum between them.
TrainsSolution with_vacuum(TrainsSolution s) {
  const bool left = !s.left.empty(), right = !s.right.empty();
  if (left) s.left_wave = fan_wave(modulation::characteristic_speeds(s.left).minus, std::tanh(s.left.phi + s.left.psi));
  if (right)
    s.right_wave = fan_wave(modulation::characteristic_speeds(s.right).plus, std::tanh(s.right.phi - s.right.psi));
  if (left) add_region(s, Region::Kind::fan, s.left_wave.outer, s.left_wave.inner, 1);
  if (left && right) add_region(s, Region::Kind::vacuum, s.left_wave.inner, s.right_wave.inner, 0);
  if (right) add_region(s, Region::Kind::fan, s.right_wave.inner, s.right_wave.outer, 1);
  return s;
}

}  // namespace

TrainsSolution solve_trains(const State& left, const State& right) {
  check_side(left, "left");
  check_side(right, "right");
  TrainsSolution s{left, right, {}, {}, {}, {}};
  const EdgeDifferences edges(left, right);
  if (left.empty() || right.empty() || edges.outer <= 0) return with_vacuum(std::move(s));
  const State between{edges.centre, edges.outer / 2};
  const bool both = edges.inner > 0;  // the trains pass through each other
  s.star =
      both ? FilledBands{edges.centre, {edges.right_width, edges.inner, edges.left_width}} : bands_of_train(between);
  const modulation::Speeds star = modulation::characteristic_speeds(between);
  if (edges.lower < 0)
    s.left_wave = fan_wave(modulation::characteristic_speeds(left).minus, star.minus);
  else if (edges.lower > 0)
    s.left_wave = {Wave::Kind::two_trains, speed_in_lower(edges, 0), speed_in_lower(edges, edges.widest_lower())};
  else
    s.left_wave = {Wave::Kind::none, star.minus, star.minus};
  if (edges.upper < 0)
    s.right_wave = fan_wave(modulation::characteristic_speeds(right).plus, star.plus);
  else if (edges.upper > 0)
    s.right_wave = {Wave::Kind::two_trains, speed_in_upper(edges, 0), speed_in_upper(edges, edges.widest_upper())};
  else
    s.right_wave = {Wave::Kind::none, star.plus, star.plus};
  add_region(s, s.left_wave);
  // If only one edge moves, the state between the waves is that of one side.
  if ((s.left_wave.kind == Wave::Kind::none) == (s.right_wave.kind == Wave::Kind::none))
    add_region(s, Region::Kind::constant, s.left_wave.inner, s.right_wave.inner, both ? 2 : 1);
  add_region(s, s.right_wave);
  return s;
}

Edges edges_of(const TrainsSolution& solution) {
  return edges_of(RiemannSolution{solution.left, solution.right, {}, solution.left_wave, solution.right_wave});
}

FilledBands bands_at(const TrainsSolution& s, double x_over_t) {
  const auto [left_edge, right_edge] = edges_of(s);
  if (x_over_t <= left_edge) return bands_or_none(s.left);
  if (x_over_t >= right_edge) return bands_or_none(s.right);
  const EdgeDifferences edges(s.left, s.right);
  if (s.left_wave.kind != Wave::Kind::none && x_over_t < s.left_wave.inner) {
    if (s.left_wave.kind == Wave::Kind::fan) return bands_or_none(state_in_left_fan(s.left.phi + s.left.psi, x_over_t));
    const auto excess = [&](double width) { return speed_in_lower(edges, width) - x_over_t; };
    const double widest = edges.widest_lower();
    return without_empty(edges.in_lower(root_in_bracket(narrowest * widest, widest, excess)));
  }
  if (s.right_wave.kind != Wave::Kind::none && x_over_t > s.right_wave.inner) {
    if (s.right_wave.kind == Wave::Kind::fan) {
      const State mirror = state_in_left_fan(s.right.psi - s.right.phi, -x_over_t);
      return bands_or_none({-mirror.phi, mirror.psi});
    }
    const auto excess = [&](double width) { return x_over_t - speed_in_upper(edges, width); };
    const double widest = edges.widest_upper();
    return without_empty(edges.in_upper(root_in_bracket(narrowest * widest, widest, excess)));
  }
  return s.star;
}

TrainsPoint profile_point(const FilledBands& bands) {
  if (bands.widths.empty()) return {};
  if (bands.widths.size() == 1) {  // the closed form, which is exact at rest
    const State one{bands.centre, bands.widths[0] / 2};
    const ProfilePoint point = profile_point(one);
    return {point, 0, train::averages(one).H, {{one.phi - one.psi, one.phi + one.psi, point.Sigma, point.W}}};
  }
  const BandAverages a = averages(bands);
  TrainsPoint point{{a.W / a.k, a.k, a.W, a.P}, 0, a.H, {}};
  const std::vector<double> edges = bands.edges();
  for (std::size_t i = 0; i < a.trains.size(); ++i)
    point.trains.push_back({edges[2 * i], edges[2 * i + 1], a.trains[i].k, a.trains[i].omega});
  return point;
}

TrainsPoint profile_point(const TrainsSolution& solution, double x_over_t) {
  TrainsPoint point = profile_point(bands_at(solution, x_over_t));
  // u = t g(x/t) has -g' = Sigma - Sigma_0 and g - (x/t) g' = W
  const double initial = profile_point(x_over_t < 0 ? solution.left : solution.right).Sigma;
  point.slip = x_over_t == 0 ? point.all.W : point.all.W - x_over_t * (point.all.Sigma - initial);
  return point;
}

StepRelations step_relations(double stress, double stress_right) {
  if (!(stress_right <= stress))
    throw InputError({.key = "stress_right",
                      .value = digits(stress_right),
                      .problem = "larger than the stress on the left",
                      .allowed = "at most " + digits(stress) + ", in mu A / pi"});
  const State left{0, from_stress(stress).psi}, right = moving_train(stress_right, 0, "stress_right");
  const TrainsSolution solution = solve_trains(left, right);
  const auto [V_minus, V_plus] = edges_of(solution);
  const TrainsPoint origin = profile_point(solution, 0);
  return {.stress = stress,
          .stress_right = stress_right,
          .rupture_velocity = -V_minus,
          .leading_velocity = V_plus,
          .velocity_ratio = -V_minus / V_plus,
          .slip_velocity = origin.all.W,
          .slip = origin.slip,
          .stress_at_origin = origin.all.Sigma,
          .dislocation_velocity_at_origin = origin.all.U,
          .trains_at_origin = static_cast<double>(origin.trains.size())};
}

std::span<const StepQuantity> step_quantities() {
  static constexpr std::array<StepQuantity, 10> all = {{
      {{"stress", "stress before the rupture", "mu A / pi", "Eq. 10"}, &StepRelations::stress},
      {{"stress_right", "stress ahead of the leading edge", "mu A / pi", "section 3.3"}, &StepRelations::stress_right},
      {{"rupture_velocity", "speed of the fast front |V-|", "c", "Eq. 10"}, &StepRelations::rupture_velocity},
      {{"leading_velocity", "speed of the slow front V+", "c", "section 3.3"}, &StepRelations::leading_velocity},
      {{"velocity_ratio", "|V- / V+|", "", "section 3.3"}, &StepRelations::velocity_ratio},
      {{"slip_velocity", "slip velocity at x = 0", "c A / pi", "Fig. 12"}, &StepRelations::slip_velocity},
      {{"slip", "slip at x = 0 over the time", "c A / pi", "Fig. 12"}, &StepRelations::slip},
      {{"stress_at_origin", "stress at x = 0", "mu A / pi", "Fig. 12"}, &StepRelations::stress_at_origin},
      {{"dislocation_velocity_at_origin", "mean velocity of the dislocations at x = 0", "c", "Fig. 12"},
       &StepRelations::dislocation_velocity_at_origin},
      {{"trains_at_origin", "number of trains at x = 0", "", "Fig. 12"}, &StepRelations::trains_at_origin},
  }};
  return all;
}

}  // namespace slipfront::rupture
