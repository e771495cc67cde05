#include "keys.hpp"

#include <string>

namespace slipfront::event {

const std::vector<Key>& quantity_keys() {
  using medium::Dimension;
  static const std::vector<Key> keys = {
      {"rupture_velocity", Dimension::velocity, &Observation::rupture_velocity},
      {"slip_velocity", Dimension::velocity, &Observation::slip_velocity},
      {"slip", Dimension::length, &Observation::slip},
      {"rise_time", Dimension::time, &Observation::rise_time},
      {"duration", Dimension::time, &Observation::duration},
      {"shear_modulus", Dimension::pressure, nullptr, &Observation::shear_modulus},
      {"poisson_ratio", Dimension::ratio, nullptr, &Observation::poisson_ratio},
      {"p_wave_speed", Dimension::velocity, nullptr, &Observation::p_wave_speed},
      {"s_wave_speed", Dimension::velocity, nullptr, &Observation::s_wave_speed},
      {"density", Dimension::density, nullptr, &Observation::density},
      {"contact_ratio", Dimension::ratio, nullptr, &Observation::contact_ratio},
      {"asperity_spacing", Dimension::length, nullptr, &Observation::asperity_spacing},
  };
  return keys;
}

const Key* find_key(std::string_view name) {
  for (const Key& key : quantity_keys())
    if (key.name == name) return &key;
  return nullptr;
}

void store(Observation& observation, const Key& key, std::string_view text, std::string_view default_unit) {
  const medium::Span span = medium::parse_quantity(text, key.dimension, default_unit);
  const auto refuse = [&](const char* problem, std::string allowed) {
    return InputError({.value = std::string(text), .problem = problem, .allowed = std::move(allowed)});
  };
  const bool positive = key.name != "poisson_ratio";  // its own range is checked with the medium
  if (positive && !(span.low > 0)) throw refuse("not positive", "> 0");
  if (key.measured) {
    observation.*key.measured = Measured{span.low, span.high};
  } else {
    if (span.low < span.high)
      throw refuse("a range, where one number is needed", std::string(medium::example(key.dimension)));
    observation.*key.constant = span.low;
  }
}

}  // namespace slipfront::event
