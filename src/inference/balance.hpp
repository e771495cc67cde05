#pragma once
/// \file
/// The one relation between what is observed and what is not: pi w / (c A) = W(Sigma-, Gamma).

#include <optional>

#include "slipfront/catalogue/observation.hpp"
#include "slipfront/rupture/relations.hpp"

namespace slipfront::inference {

/// One pulse of known rupture velocity, whatever its friction.
struct Pulse {
  double stress;        ///< Sigma-, within the table's range
  double frictionless;  ///< W(0) without friction
  catalogue::Measure measure;
  friction::Closure closure;

  /// W with friction, and its slope d ln W / d ln(1 + Gamma), <= 0.
  struct At {
    double W, slope;
  };
  At at(double u) const;
};

/// W without friction. Of all but the mean over the fault it is the closed form's W(0); that is a share of it, which
/// the table has for 0.05 <= Sigma- <= 3 (beyond, that of its end).
double frictionless(catalogue::Measure measure, double stress, double W_at_origin);

/// u = ln(1 + Gamma) at which the pulse slips with W; absent where no 0 <= Gamma <= 1e8 does.
struct Damped {
  double u, slope;
};
std::optional<Damped> damping_at(const Pulse& pulse, double W);

/// Contact ratio A with A W(Gamma = A per_contact) = `product`, and u there; absent unless `least` <= A <= `most`.
struct Balanced {
  double contact_ratio, u, slope;
};
std::optional<Balanced> contact_at(const Pulse& pulse, double product, double per_contact, double least, double most);

}  // namespace slipfront::inference
