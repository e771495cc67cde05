// The registry of friction laws: a declaration and an entry for each. Each law is defined in its own file.

#include "slipfront/friction/law.hpp"

namespace slipfront::friction {

const Definition& no_law();
const Definition& viscous_law();
const Definition& coulomb_law();
const Definition& power_law();

const std::vector<const Definition*>& laws() {
  static const std::vector<const Definition*> all = {&no_law(), &viscous_law(), &coulomb_law(), &power_law()};
  return all;
}

}  // namespace slipfront::friction
