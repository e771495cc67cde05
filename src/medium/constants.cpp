#include "slipfront/medium/constants.hpp"

namespace slipfront::medium {

const std::vector<Constant>& constants() {
  static const std::vector<Constant> all = {
      {"shear_modulus", Dimension::pressure, &Constants::shear_modulus},
      {"poisson_ratio", Dimension::ratio, &Constants::poisson_ratio},
      {"p_wave_speed", Dimension::velocity, &Constants::p_wave_speed},
      {"s_wave_speed", Dimension::velocity, &Constants::s_wave_speed},
      {"density", Dimension::density, &Constants::density},
      {"contact_ratio", Dimension::ratio, &Constants::contact_ratio},
      {"asperity_spacing", Dimension::length, &Constants::asperity_spacing},
  };
  return all;
}

}  // namespace slipfront::medium
