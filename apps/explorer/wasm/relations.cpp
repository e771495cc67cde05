/// \file
/// The functions of panel "Stress and velocity": the closed form (Eqs. 8-10).

#include "slipfront/theory/rupture/relations.hpp"

#include <cmath>

#include "answer.hpp"
#include "math/digits.hpp"
#include "slipfront/error.hpp"
#include "slipfront/theory/rupture/riemann.hpp"

namespace slipfront::explorer {
namespace {

using rupture::Relations;

Relations solve(int given, double value) {
  if (given == 0) return rupture::from_stress(value);
  return given == 1 ? rupture::from_rupture_velocity(value) : rupture::from_slip_velocity(value);
}

constexpr int most_points = 20000;

}  // namespace

/// All quantities of one pulse. `given` is 0 for stress, 1 for rupture velocity, 2 for slip velocity.
SLIPFRONT_EXPORT const char* relations(int given, double value) {
  return answer([=] {
    Object object;
    const Relations r = solve(given, value);
    for (const auto& q : rupture::relations_quantities()) object.put(q.about.name, r.*q.value);
    return object;
  });
}

/// The names, units and references of the quantities.
SLIPFRONT_EXPORT const char* relations_quantities() {
  return answer([] {
    std::vector<Object> all;
    for (const auto& q : rupture::relations_quantities())
      all.push_back(Object()
                        .put("name", q.about.name)
                        .put("long_name", q.about.long_name)
                        .put("unit", q.about.dimensional_unit)
                        .put("reference", q.about.reference));
    return Object().put("quantities", all);
  });
}

/// One array per quantity, for `points` values of the given quantity from `from` to `to`. With `by_logarithm`, the
/// values are evenly spaced in the logarithm. Values outside the allowed range are omitted.
SLIPFRONT_EXPORT const char* relations_curve(int given, double from, double to, int points, int by_logarithm) {
  return answer([=] {
    if (points < 2 || points > most_points)
      throw InputError({.key = "points", .problem = "out of range", .allowed = "2 to 20000"});
    std::vector<Relations> rows;
    for (int i = 0; i < points; ++i) {
      const double share = i / (points - 1.0);
      const double value = by_logarithm ? std::exp(std::log(from) + share * (std::log(to) - std::log(from)))
                                        : from + share * (to - from);
      try {
        rows.push_back(solve(given, i == points - 1 ? to : value));
      } catch (const InputError&) {
      }
    }
    Object object;
    for (const auto& q : rupture::relations_quantities()) {
      std::vector<double> column;
      for (const Relations& row : rows) column.push_back(row.*q.value);
      object.numbers(q.about.name, column);
    }
    return object;
  });
}

/// The frictionless pulse over x / t (Eqs. 8-9).
SLIPFRONT_EXPORT const char* relations_profile(double stress, int points) {
  return answer([=] {
    if (points < 2 || points > most_points)
      throw InputError({.key = "points", .problem = "out of range", .allowed = "2 to 20000"});
    const rupture::RiemannSolution pulse = rupture::slip_pulse(stress);
    const double left = 1.1 * pulse.left_wave.outer, right = 1.3 * pulse.left_wave.inner;
    std::vector<double> x, Sigma, W, U;
    for (int i = 0; i < points; ++i) {
      x.push_back(left + (right - left) * i / (points - 1));
      const rupture::ProfilePoint at = rupture::profile_point(pulse, x.back());
      Sigma.push_back(at.Sigma);
      W.push_back(at.W);
      U.push_back(at.U);
    }
    return Object().numbers("x_over_t", x).numbers("Sigma", Sigma).numbers("W", W).numbers("U", U);
  });
}

}  // namespace slipfront::explorer
