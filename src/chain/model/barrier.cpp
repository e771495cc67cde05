#include "chain/model/barrier.hpp"

#include <cmath>
#include <numbers>

namespace slipfront::chain {

double barrier_force(double spacing) {
  constexpr double pi = std::numbers::pi;
  return 40 * pi / (spacing * spacing) * std::exp(-pi * pi / spacing);
}

double spacing_with_barrier_below(double force, double spacing) {
  double hundredths = std::floor(100 * spacing);
  while (hundredths > 1 && barrier_force(hundredths / 100) > force) --hundredths;
  return hundredths / 100;
}

}  // namespace slipfront::chain
