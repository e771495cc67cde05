#pragma once
/// \file
/// The constants of rock and interface that a file may state, each under the one name it has in every format, and
/// the defaults for those that it does not state.

#include <optional>
#include <string>
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

/// One of these constants: its name in files, its dimension, its meaning in a few words, and its member.
struct Constant {
  std::string_view name;
  Dimension dimension;
  std::string_view meaning;
  std::optional<double> Constants::*member;
};
const std::vector<Constant>& constants();

/// Elastic constants for events that do not carry their own. The defaults are the paper's; using one of them adds a
/// warning, unless `stated` says that the user chose them.
struct Defaults {
  double p_wave_speed = 6000;   ///< m/s
  double poisson_ratio = 0.3;   ///< -1 < nu < 0.5
  double shear_modulus = 30e9;  ///< Pa
  bool stated_speed = false;    ///< p_wave_speed was chosen by the user
  bool stated_poisson = false;  ///< poisson_ratio was chosen by the user
  bool stated_modulus = false;  ///< shear_modulus was chosen by the user
};

/// The constants as a user states them, such as "6 km/s", "0.3" and "30 GPa"; empty: the default.
struct StatedDefaults {
  std::string p_wave_speed, poisson_ratio, shear_modulus;
};
/// \throws InputError that names the option.
Defaults defaults_of(const StatedDefaults& stated);

/// Elastic constants of one event, after the defaults have filled the gaps.
struct Elastic {
  double speed;  ///< c, m/s
  double shear_modulus;
  double poisson_ratio;
};

/// Names in `assumed`, if it is given, the defaults that were used. \throws InputError for constants out of range.
Elastic elastic(const Constants& constants, const Defaults& defaults, std::string* assumed = nullptr);

}  // namespace slipfront::medium
