#include "slipfront/medium/constants.hpp"

namespace slipfront::medium {

const std::vector<Constant>& constants() {
  static const std::vector<Constant> all = {
      {"shear_modulus", Dimension::pressure, "shear modulus mu of the rock", &Constants::shear_modulus},
      {"poisson_ratio", Dimension::ratio, "Poisson's ratio nu", &Constants::poisson_ratio},
      {"p_wave_speed", Dimension::velocity, "speed of P waves", &Constants::p_wave_speed},
      {"s_wave_speed", Dimension::velocity, "speed of S waves", &Constants::s_wave_speed},
      {"density", Dimension::density, "density rho of the rock", &Constants::density},
      {"contact_ratio", Dimension::ratio, "contact ratio A: real over nominal area of contact",
       &Constants::contact_ratio},
      {"asperity_spacing", Dimension::length, "asperity spacing b", &Constants::asperity_spacing},
  };
  return all;
}

}  // namespace slipfront::medium
