#pragma once
/// \file
/// Friction laws and the two ways to average them over a period (docs/theory.md 3.3; Eqs. 7).

#include <cstddef>
#include <string_view>
#include <vector>

#include "slipfront/train/state.hpp"

namespace slipfront::modulation {

/// Force f(w) that opposes slip, in the unit of F (medium::traction_unit).
enum class FrictionLaw {
  none,
  viscous,  ///< f = C w
  coulomb,  ///< f = C sign(w); sticks at U = 0 while the force on it is smaller
  power,    ///< f = C |w|^(n-1) w, n > 0
};

/// How f enters the momentum law P_t + Q_x = F k - loss.
enum class Closure {
  consistent,  ///< loss = <f(w) sigma>, the exact average
  paper,       ///< loss = k <f(w)>, as the paper's Eqs. (7) have it; understates friction
};

/// "consistent" or "paper", and back. \throws InputError (key "closure") for any other word.
const char* name_of(Closure closure);
Closure closure_named(std::string_view name);

struct Friction {
  FrictionLaw law = FrictionLaw::none;
  double coefficient = 0;  ///< C >= 0
  double exponent = 1;     ///< n of the power law
  Closure closure = Closure::consistent;

  bool acts() const { return law != FrictionLaw::none && coefficient > 0; }
};

/// Rate of momentum loss per unit length, with the sign of U. Zero for the empty state.
double momentum_loss(const State& state, const Friction& friction);

/// Rate at which friction relaxes the momentum, momentum_loss / P, with its limit at rest; 0 for Coulomb friction,
/// which relaxes nothing but stops it. Times that resolve it are explicit, longer ones implicit.
double relaxation_rate(const State& state, const Friction& friction);

/// The same for the power law at many states: the rate is C (2 sinh |phi| cosh psi)^(n - 1) g(psi), and g is looked up
/// in a table of ln psi that fills as it is used, to 1e-10. Not from two threads at once.
class PowerLawRate {
 public:
  explicit PowerLawRate(const Friction& friction);
  double operator()(const State& state) const;

 private:
  double shape(double psi) const;
  double node(std::size_t i) const;

  Friction friction_;
  mutable std::vector<double> nodes_;  ///< g, NaN where not yet known
};

}  // namespace slipfront::modulation
