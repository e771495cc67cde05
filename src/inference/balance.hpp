#pragma once
/// \file
/// Solves the relation between observed and inferred quantities, pi w / (c A) = W(Sigma-, Gamma).

#include <optional>

#include "slipfront/catalogue/observation.hpp"
#include "slipfront/rupture/relations.hpp"

namespace slipfront::inference {

/// A pulse of known rupture velocity and unknown friction.
struct Pulse {
  double stress;        ///< Sigma-, within the range of the table
  double frictionless;  ///< W(0) without friction
  catalogue::Measure measure;
  friction::Closure closure;

  /// W with friction, and its slope d ln W / d ln(1 + Gamma), which is <= 0.
  struct At {
    double W, slope;
  };
  At at(double u) const;
};

/// W without friction. For every measure except the mean over the fault, it is W(0) of the closed form. The mean is a
/// fraction of W(0), which the table has for 0.05 <= Sigma- <= 3. Outside this range we use the value at its end.
double frictionless(catalogue::Measure measure, double stress, double W_at_origin);

/// u = ln(1 + Gamma) at which the pulse slips with W. It is absent if there is none for 0 <= Gamma <= 1e8.
struct Damped {
  double u, slope;
};
std::optional<Damped> damping_at(const Pulse& pulse, double W);

/// The contact ratio A with A W(Gamma) = `product` and Gamma = A `per_contact`, and u at that Gamma. It is absent if
/// there is none with `least` <= A <= `most`.
struct Balanced {
  double contact_ratio, u, slope;
};
std::optional<Balanced> contact_at(const Pulse& pulse, double product, double per_contact, double least, double most);

}  // namespace slipfront::inference
