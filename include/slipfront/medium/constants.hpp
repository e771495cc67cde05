#pragma once
/// \file
/// The constants of rock and interface that a file may state, each under the one name it has in every format.

#include <optional>
#include <string_view>
#include <vector>

#include "slipfront/medium/quantity.hpp"

namespace slipfront::medium {

/// SI units; absent where a file does not say.
struct Constants {
  std::optional<double> shear_modulus;     ///< Pa
  std::optional<double> poisson_ratio;     ///< -1 < nu < 0.5
  std::optional<double> p_wave_speed;      ///< m/s
  std::optional<double> s_wave_speed;      ///< m/s
  std::optional<double> density;           ///< kg/m^3
  std::optional<double> contact_ratio;     ///< A, real to nominal contact area
  std::optional<double> asperity_spacing;  ///< b, m
};

/// One of them: its name in files, what it is, where it goes.
struct Constant {
  std::string_view name;
  Dimension dimension;
  std::optional<double> Constants::*member;
};
const std::vector<Constant>& constants();

}  // namespace slipfront::medium
