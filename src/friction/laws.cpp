// The registry of friction laws: a declaration and an entry for each. Each law is defined in its own file.

#include "slipfront/friction/law.hpp"

namespace slipfront::friction {

const Definition& no_law();
const Definition& viscous_law();
const Definition& coulomb_law();
const Definition& power_law();
const Definition& formula_law();
const Definition& table_law();
const Definition& n_shaped_law();
const Definition& flash_heating_law();
const Definition& slip_weakening_law();
const Definition& rate_and_state_law();

const std::vector<const Definition*>& laws() {
  static const std::vector<const Definition*> all = {
      &no_law(),    &viscous_law(),  &coulomb_law(),       &power_law(),          &formula_law(),
      &table_law(), &n_shaped_law(), &flash_heating_law(), &slip_weakening_law(), &rate_and_state_law()};
  return all;
}

}  // namespace slipfront::friction
