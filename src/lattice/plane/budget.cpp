#include "lattice/plane/budget.hpp"

#include <algorithm>
#include <cmath>

#include "math/digits.hpp"
#include "slipfront/error.hpp"

namespace slipfront::plane {

Budget::Budget(const Energies& e)
    : largest(std::max({e.kinetic, std::fabs(e.elastic), e.dissipated, std::fabs(e.supplied)})),
      missing(e.supplied - e.kinetic - e.elastic - e.dissipated - e.vanished - e.radiated) {}

std::string Budget::in_words() const {
  return digits(100 * std::fabs(missing) / largest, 3) + " % of its largest part";
}

void check_budget(const Energies& energies, double noise, double time, const std::string& remedy) {
  constexpr double most = 0.1;
  const Budget budget(energies);
  if (-budget.missing > std::max(most * budget.largest, noise))
    throw NumericsError("t = " + digits(time) + ": the energy exceeds what was released by " + budget.in_words() +
                        "; " + remedy);
}

}  // namespace slipfront::plane
