#pragma once
/// \file
/// The observed front and the stress drops of a computed pulse, and their closed forms without friction. The tables of
/// `friction_ratio/front.hpp` are generated from these values and checked against them.

#include "solve.hpp"

namespace slipfront::friction_ratio {

/// |x_front(T)| / (|V-| T): x_front is the farthest x < 0 at which W is `threshold` times its peak.
double observed_front(const Pulse& pulse, double stress, double threshold);
double frictionless_front(double stress, double threshold);

/// Stress drops over Sigma- (slipfront/friction_ratio/front.hpp).
struct DropShares {
  double origin, mean;
};
DropShares observed_drops(const Pulse& pulse, double stress);
DropShares frictionless_drops(double stress);

}  // namespace slipfront::friction_ratio
