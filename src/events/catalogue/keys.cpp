#include "events/catalogue/keys.hpp"

#include <algorithm>
#include <cmath>
#include <string>
#include <string_view>
#include <utility>

#include "math/digits.hpp"
#include "text/characters.hpp"
#include "text/units.hpp"

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

void store(Observation& observation, const Key& key, const MeasuredValue& measured, std::string_view text) {
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

std::optional<MeasuredValue> value_of(const Observation& o, const Key& key) {
  if (key.measured) return o.*key.measured;
  for (const UncertainConstant& c : o.uncertain_constants)
    if (c.member == key.constant) return c.measured;
  const auto& constant = o.*key.constant;
  return constant ? std::optional(MeasuredValue{*constant, *constant}) : std::nullopt;
}

namespace {

using Shape = MeasuredValue::Shape;

/// Standard deviation of ln x; that of a range is of the uniform distribution.
double log_error(const MeasuredValue& m) {
  switch (m.shape) {
    case Shape::range:
      return m.is_exact() ? 0 : std::log(m.high / m.low) / std::sqrt(12.0);
    case Shape::normal:
      return m.spread / m.low;
    case Shape::lognormal:
      return std::log(m.spread);
    case Shape::split:
      break;
  }
  return (m.spread + m.spread_below) / 2 / m.low;
}

/// The quantity times an exact number.
MeasuredValue scaled(MeasuredValue m, double factor) {
  m.low *= factor;
  m.high *= factor;
  if (m.shape != Shape::lognormal) m.spread *= factor;
  m.spread_below *= factor;
  return m;
}

/// a times b^power, for power 1 or -1. If both have errors, the result is lognormal, and the errors of ln add in
/// quadrature.
MeasuredValue product(const MeasuredValue& a, const MeasuredValue& b, int power) {
  const double middle = power > 0 ? b.middle() : 1 / b.middle();
  if (b.is_exact()) return scaled(a, middle);
  if (a.is_exact() && power > 0) return scaled(b, a.low);
  if (a.is_exact() && b.shape == Shape::range) return {a.low / b.high, a.low / b.low};
  const double value = a.middle() * middle;
  return {value, value, Shape::lognormal, std::exp(std::hypot(log_error(a), log_error(b)))};
}

/// M0 = 10^(1.5 Mw + 9.1) N m, the standard of IASPEI.
double moment_of(double magnitude) { return std::pow(10.0, 1.5 * magnitude + 9.1); }

MeasuredValue moment_of(const MeasuredValue& m) {
  const double moment = moment_of(m.middle());
  if (m.is_exact()) return {moment, moment};
  if (m.shape == Shape::range) return {moment_of(m.low), moment_of(m.high)};
  if (m.shape == Shape::lognormal) return {moment, moment};
  const double error = m.shape == Shape::normal ? m.spread : (m.spread + m.spread_below) / 2;
  return {moment, moment, Shape::lognormal, std::pow(10.0, 1.5 * error)};
}

bool is_bounded(const Observation& o, std::string_view quantity) {
  return std::any_of(o.bounds.begin(), o.bounds.end(), [&](const Bound& b) { return b.quantity == quantity; });
}

void derive_slip(Observation& o, double shear_modulus) {
  if (o.slip || o.slip_velocity_m_s || is_bounded(o, "slip") || is_bounded(o, "slip_velocity")) return;
  if (!o.moment && !o.moment_magnitude) return;
  std::string area_is = "rupture_area";
  auto area = o.rupture_area;
  if (!area && o.rupture_length && o.rupture_width) {
    area = product(*o.rupture_length, *o.rupture_width, 1);
    area_is = "rupture_length rupture_width";
  }
  if (!area) return;
  const MeasuredValue moment = o.moment ? *o.moment : moment_of(*o.moment_magnitude);
  const MeasuredValue slip = scaled(product(moment, *area, -1), 1 / shear_modulus);
  if (!std::isfinite(slip.low) || !std::isfinite(slip.high) || !(slip.low > 0)) return;
  o.slip = slip;
  o.warnings.push_back("slip is moment / (shear_modulus " + area_is + ")" +
                       (o.moment ? "" : ", with the moment of moment_magnitude"));
}

void derive_rupture_velocity(Observation& o, double speed) {
  if (o.rupture_velocity_m_s || is_bounded(o, "rupture_velocity") || !o.rupture_length || !o.duration) return;
  const MeasuredValue velocity = product(*o.rupture_length, *o.duration, -1);
  if (!std::isfinite(velocity.high) || !(velocity.low > 0)) return;
  if (!(velocity.high < speed)) {
    o.warnings.push_back("rupture_length / duration is " + digits(velocity.middle()) +
                         " m/s, not below c: not used as rupture_velocity");
    return;
  }
  o.rupture_velocity_m_s = velocity;
  o.warnings.push_back(
      "rupture_velocity is rupture_length / duration: apparent; a front that spreads both ways is about half as fast");
}

}  // namespace

void derive_stress_drop(Observation& o) {
  if (o.stress_drop || !o.shear_stress || !o.shear_stress_after) return;
  const MeasuredValue &before = *o.shear_stress, &after = *o.shear_stress_after;
  const double drop = before.middle() - after.middle();
  if (!(drop > 0))
    throw InputError({.key = "shear_stress_after",
                      .value = digits(after.middle()) + " Pa",
                      .problem = "not below the shear stress before",
                      .allowed = "< " + digits(before.middle()) + " Pa"});
  const double error = std::hypot(before.middle() * log_error(before), after.middle() * log_error(after));
  o.stress_drop = error > 0 ? MeasuredValue{drop, drop, Shape::normal, error} : MeasuredValue{drop, drop};
}

void derive(Observation& observation, double shear_modulus, double speed) {
  derive_slip(observation, shear_modulus);
  derive_rupture_velocity(observation, speed);
}

}  // namespace slipfront::catalogue
