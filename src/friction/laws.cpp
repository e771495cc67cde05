// The registry of friction laws. Each law is defined in its own file in laws/.

#include "slipfront/friction/friction.hpp"

// One line a law, in the order in which users see them.
#define SLIPFRONT_EACH_LAW(LAW) \
  LAW(no_law)                   \
  LAW(viscous_law)              \
  LAW(coulomb_law)              \
  LAW(power_law)                \
  LAW(formula_law)              \
  LAW(table_law)                \
  LAW(n_shaped_law)             \
  LAW(flash_heating_law)        \
  LAW(slip_weakening_law)       \
  LAW(rate_and_state_law)

namespace slipfront::friction {

#define SLIPFRONT_DECLARE(law) const Definition& law();
SLIPFRONT_EACH_LAW(SLIPFRONT_DECLARE)

const std::vector<const Definition*>& laws() {
#define SLIPFRONT_ENTRY(law) &law(),
  static const std::vector<const Definition*> all = {SLIPFRONT_EACH_LAW(SLIPFRONT_ENTRY)};
  return all;
}

Friction::Friction() : Friction(no_law(), {}) {}

Friction viscous(double coefficient, Closure closure) { return {viscous_law(), {coefficient}, closure}; }
Friction coulomb(double coefficient, Closure closure) { return {coulomb_law(), {coefficient}, closure}; }
Friction power(double coefficient, double exponent, Closure closure) {
  return {power_law(), {coefficient, exponent}, closure};
}

}  // namespace slipfront::friction
