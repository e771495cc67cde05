#include "keys.hpp"

#include <string>

namespace slipfront::event {

const std::vector<Key>& quantity_keys() {
  using medium::Dimension;
  static const std::vector<Key> keys = [] {
    std::vector<Key> all = {
        {"rupture_velocity", Dimension::velocity, &Observation::rupture_velocity},
        {"slip_velocity", Dimension::velocity, &Observation::slip_velocity},
        {"slip", Dimension::length, &Observation::slip},
        {"rise_time", Dimension::time, &Observation::rise_time},
        {"duration", Dimension::time, &Observation::duration},
    };
    for (const medium::Constant& constant : medium::constants())
      all.push_back({constant.name, constant.dimension, nullptr, constant.member});
    return all;
  }();
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
