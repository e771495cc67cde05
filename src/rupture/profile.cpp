#include <array>
#include <cmath>

#include "foundation/text/digits.hpp"
#include "slipfront/error.hpp"
#include "slipfront/rupture/relations.hpp"
#include "slipfront/rupture/riemann.hpp"
#include "slipfront/train/train.hpp"

namespace slipfront::rupture {

RiemannSolution slip_pulse(double stress) { return solve_riemann({0, from_stress(stress).psi}, State{}); }

std::string_view name_of(Wave::Kind kind) {
  static constexpr std::array<std::string_view, 4> names = {"none", "fan", "shock", "two-trains"};
  return names[static_cast<std::size_t>(kind)];
}

ProfilePoint profile_point(const State& state) {
  const train::Averages a = train::averages(state);
  return {state.empty() ? 0.0 : std::tanh(state.phi), a.k, a.W, a.P};
}

ProfilePoint profile_point(const RiemannSolution& solution, double x_over_t) {
  return profile_point(sample(solution, x_over_t));
}

std::span<const ProfileQuantity> profile_quantities() {
  static constexpr std::array<ProfileQuantity, 4> all = {{
      {{"U", "velocity of the dislocations", "c", "Eqs. 8-9"}, &ProfilePoint::U},
      {{"Sigma", "stress", "mu A / pi", "Eqs. 8-9"}, &ProfilePoint::Sigma},
      {{"W", "slip velocity", "c A / pi", "Eqs. 8-9"}, &ProfilePoint::W},
      {{"P", "momentum density", "", "Eqs. 8-9"}, &ProfilePoint::P},
  }};
  return all;
}

State moving_train(double stress, double velocity, const std::string& side) {
  constexpr double most_stress = 1e6;
  if (!(std::fabs(velocity) <= 0.999999))
    throw InputError({.key = side + "_velocity",
                      .value = digits(velocity),
                      .problem = "out of range",
                      .allowed = "-0.999999 ... 0.999999, in c"});
  const double phi = std::atanh(velocity), at_rest = stress / std::cosh(phi);
  if (stress == 0) return {phi, 0};
  if (!(at_rest >= train::smallest_stress && stress <= most_stress))
    throw InputError(
        {.key = side + "_stress",
         .value = digits(stress),
         .problem = "out of range",
         .allowed = "0, or " + digits(train::smallest_stress * std::cosh(phi), 4) + " ... 1e6, in mu A / pi"});
  return {phi, train::psi_of_stress(at_rest)};
}

}  // namespace slipfront::rupture
