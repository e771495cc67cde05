#include "catalogue/keys.hpp"

#include <string>
#include <utility>

#include "foundation/text/trimmed.hpp"
#include "medium/plain_text.hpp"

namespace slipfront::catalogue {

const std::vector<Key>& quantity_keys() {
  using medium::Dimension;
  static const std::vector<Key> keys = [] {
    std::vector<Key> all = {
        {"rupture_velocity", Dimension::velocity, &Observation::rupture_velocity_m_s},
        {"slip_velocity", Dimension::velocity, &Observation::slip_velocity_m_s},
        {"slip", Dimension::length, &Observation::slip},
        {"rise_time", Dimension::time, &Observation::rise_time},
        {"duration", Dimension::time, &Observation::duration},
        {"rupture_length", Dimension::length, &Observation::rupture_length},
        {"rupture_width", Dimension::length, &Observation::rupture_width},
        {"rupture_area", Dimension::area, &Observation::rupture_area},
        {"moment", Dimension::moment, &Observation::moment},
        {"moment_magnitude", Dimension::ratio, &Observation::moment_magnitude},
        {"stress_drop", Dimension::pressure, &Observation::stress_drop},
        {"friction_coefficient", Dimension::ratio, &Observation::friction_coefficient},
        {"normal_stress", Dimension::pressure, &Observation::normal_stress},
        {"hardness", Dimension::pressure, &Observation::hardness},
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
  const std::string name(key.name);
  std::string plain = medium::plain_number(text);
  if (auto bound = parse_bound(plain, key.dimension, default_unit)) {
    observation.warnings.push_back(name + " is only bounded (" + std::string(trimmed(text)) + "): not used as a value");
    bound->quantity = name;
    observation.bounds.push_back(std::move(*bound));
    return;
  }
  for (const std::string_view about : {"~", "ca.", "about "}) {
    if (!plain.starts_with(about)) continue;
    plain.erase(0, about.size());
    store(observation, key, parse_measured(plain, key.dimension, default_unit), text);
    observation.warnings.push_back(name + " is approximate (" + std::string(trimmed(text)) +
                                   "): taken as it is written");
    return;
  }
  store(observation, key, parse_measured(text, key.dimension, default_unit), text);
}

void store(Observation& observation, const Key& key, const Measured& measured, std::string_view text) {
  const bool positive =
      key.name != "poisson_ratio" && key.name != "moment_magnitude";  // the medium checks Poisson's ratio
  if (positive && !(measured.low > 0))
    throw InputError({.value = std::string(text), .problem = "not positive", .allowed = "> 0"});
  if (key.measured) {
    observation.*key.measured = measured;
  } else {
    observation.*key.constant = measured.middle();
    if (!measured.is_exact()) observation.uncertain_constants.push_back({key.constant, measured});
  }
}

}  // namespace slipfront::catalogue
