#pragma once
/// \file
/// The exact solution of the Riemann problem without friction: two uniform trains meet at x = 0, and where dislocations
/// overtake each other there are two trains at one position (docs/theory/9_trains.md 9.4). No wave is a shock, and the
/// solution is the same in every frame. riemann.hpp has the approximation by one train with shocks.

#include <cstddef>
#include <string_view>
#include <vector>

#include "slipfront/theory/rupture/riemann.hpp"
#include "slipfront/theory/rupture/trains.hpp"

namespace slipfront::rupture {

/// A range of x/t between the left and right edges of the moving region.
struct Region {
  enum class Kind {
    constant,    ///< the state between the waves: one train, or two trains that pass through each other unchanged
    fan,         ///< one train that depends on x/t
    two_trains,  ///< two trains, of which an edge depends on x/t
    vacuum       ///< no dislocations
  };
  Kind kind;
  double from, to;     ///< x/t
  std::size_t trains;  ///< number of trains at one position: 0, 1 or 2
};

/// "constant", "fan", "two-trains" or "vacuum".
std::string_view name_of(Region::Kind kind);

/// The solution for all x/t.
struct TrainsSolution {
  State left, right;
  FilledBands star;             ///< trains between the waves; no widths: none
  Wave left_wave, right_wave;   ///< none, fan or two-trains: the waves of the lower and of the upper edge
  std::vector<Region> regions;  ///< from left to right; a region without width is left out
};

/// Solves for any left and right states. An empty state (psi = 0) has no dislocations, and its phi is ignored. The
/// edges of waves have the error of edge_speeds. \throws InputError unless 0 <= psi <= 20 and |phi| <= 18.
TrainsSolution solve_trains(const State& left, const State& right);

/// x/t of the left and right edges of the moving region, as for the solution with shocks.
Edges edges_of(const TrainsSolution& solution);

/// The trains at x/t; no widths: none.
FilledBands bands_at(const TrainsSolution& solution, double x_over_t);

/// One of the trains at one x/t.
struct TrainAt {
  double lowest, highest;  ///< rapidities of its edges
  double Sigma;            ///< its share of the stress
  double W;                ///< its share of the slip velocity
};

/// The averages at one x/t.
struct TrainsPoint {
  ProfilePoint all;             ///< over all trains; U = W / Sigma is the mean velocity of the dislocations
  double slip;                  ///< slip since t = 0 over t, W - (x / t) (Sigma - Sigma at t = 0)
  double H;                     ///< energy density
  std::vector<TrainAt> trains;  ///< from the slowest up
};
TrainsPoint profile_point(const FilledBands& bands);  ///< its slip is 0
TrainsPoint profile_point(const TrainsSolution& solution, double x_over_t);

/// The pulse from a step of stress `left` into a smaller stress `right`, both at rest.
struct StepRelations {
  double stress, stress_right;
  double rupture_velocity;                ///< |V-|, speed of the fast front into the side with the larger stress
  double leading_velocity;                ///< V+, the slow front
  double velocity_ratio;                  ///< |V- / V+|
  double slip_velocity;                   ///< W(0)
  double slip;                            ///< slip at x = 0 over t; equal to W(0), which is constant
  double stress_at_origin;                ///< Sigma(0)
  double dislocation_velocity_at_origin;  ///< mean velocity W(0) / Sigma(0)
  double trains_at_origin;                ///< number of trains at x = 0
};
/// \throws InputError unless the stresses are in the range of from_stress, or stress_right is 0, and
/// stress_right <= stress.
StepRelations step_relations(double stress, double stress_right);

/// The members of StepRelations, with their descriptions, in the order of their declaration.
struct StepQuantity {
  Description about;
  double StepRelations::*value;
};
std::span<const StepQuantity> step_quantities();

}  // namespace slipfront::rupture
