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

const std::vector<Key>& front_keys() {
  static const std::vector<Key> keys = {
      {"shear_stress", medium::Dimension::pressure, &Observation::shear_stress},
      {"shear_stress_after", medium::Dimension::pressure, &Observation::shear_stress_after},
      *find_key("normal_stress"),
      *find_key("rupture_velocity"),
      *find_key("stress_drop")};
  return keys;
}

const Key* find_key(std::string_view name, const std::vector<Key>& keys) {
  for (const Key& key : keys)
    if (key.name == name) return &key;
  return nullptr;
}

const std::vector<std::string_view>& text_keys() {
  static const std::vector<std::string_view> keys = {
      "name",           "date",           "kind", "citation", "note", "slip_velocity_is", "rupture_velocity_is",
      "stress_drop_is", "front_threshold"};
  return keys;
}

void store_text(Observation& o, std::string_view key, const std::string& text) {
  if (key == "name") o.name = text;
  if (key == "date") o.date = text;
  if (key == "kind") o.kind = text;
  if (key == "citation") o.citation = text;
  if (key == "note") o.note = text;
  if (key == "study") o.study = text;
  if (key == "slip_velocity_is") o.slip_velocity_is = friction_ratio::measure_named(text);
  if (key == "rupture_velocity_is") o.rupture_velocity_is = rupture_velocity_meaning(text);
  if (key == "stress_drop_is") o.stress_drop_is = stress_drop_meaning(text);
  if (key == "front_threshold") o.front_threshold = parse_front_threshold(text);
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

std::optional<Measured> value_of(const Observation& o, const Key& key) {
  if (key.measured) return o.*key.measured;
  for (const UncertainConstant& c : o.uncertain_constants)
    if (c.member == key.constant) return c.measured;
  const auto& constant = o.*key.constant;
  return constant ? std::optional(Measured{*constant, *constant}) : std::nullopt;
}

}  // namespace slipfront::catalogue
