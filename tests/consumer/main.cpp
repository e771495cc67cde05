#include <cmath>
#include <cstdio>

#include "all_headers.hpp"

int main() {
  const auto pulse = slipfront::rupture::from_stress(1.03);
  std::printf("%.5f\n", pulse.rupture_velocity);
  return std::fabs(pulse.rupture_velocity - 0.54390) < 1e-5 ? 0 : 1;
}
