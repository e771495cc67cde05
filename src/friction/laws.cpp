// The registry of friction laws: a declaration and an entry for each.

#include "laws.hpp"

namespace slipfront::friction {

const std::vector<const Definition*>& laws() {
  static const std::vector<const Definition*> all = {&no_law(), &viscous_law(), &coulomb_law(), &power_law()};
  return all;
}

}  // namespace slipfront::friction
