#pragma once
/// \file
/// The constants of rock and interface that a file may give, and the defaults for those that it does not give. A
/// constant has the same name in every file format.

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "slipfront/text/quantity.hpp"

namespace slipfront::medium {

/// Constants in SI units. A constant that the file does not give is absent.
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

/// Elastic constants for events that do not give their own. The defaults are those of the paper. Using one of them adds
/// a warning, unless the user chose it.
struct Defaults {
  double p_wave_speed = 6000;   ///< m/s
  double poisson_ratio = 0.3;   ///< -1 < nu < 0.5
  double shear_modulus = 30e9;  ///< Pa
  bool stated_speed = false;    ///< p_wave_speed was chosen by the user
  bool stated_poisson = false;  ///< poisson_ratio was chosen by the user
  bool stated_modulus = false;  ///< shear_modulus was chosen by the user
};

/// The constants as the user writes them, such as "6 km/s", "0.3" and "30 GPa". An empty text means the default.
struct StatedDefaults {
  std::string p_wave_speed, poisson_ratio, shear_modulus;
};
/// Parses the constants. \throws InputError that names the option.
Defaults defaults_of(const StatedDefaults& stated);

/// Elastic constants of one event. Defaults replace those that the event does not give.
struct Elastic {
  double speed;  ///< c, m/s
  double shear_modulus;
  double poisson_ratio;
};

/// Elastic constants of an event. Unless `assumed` is null, it receives the names of the defaults that were used.
/// \throws InputError for constants out of range.
Elastic elastic(const Constants& constants, const Defaults& defaults, std::string* assumed = nullptr);

}  // namespace slipfront::medium
