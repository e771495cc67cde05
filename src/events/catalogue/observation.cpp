#include "slipfront/events/catalogue/observation.hpp"

#include "math/digits.hpp"
#include "slipfront/text/quantity.hpp"
#include "text/characters.hpp"

namespace slipfront::catalogue {

const char* name_of(RuptureVelocityIs meaning) {
  return meaning == RuptureVelocityIs::front ? "front" : "characteristic";
}

const char* name_of(StressDropIs meaning) { return meaning == StressDropIs::static_drop ? "static" : "stored"; }

RuptureVelocityIs rupture_velocity_meaning(std::string_view name) {
  for (const auto meaning : {RuptureVelocityIs::front, RuptureVelocityIs::characteristic})
    if (name == name_of(meaning)) return meaning;
  throw InputError({.value = std::string(name), .problem = "unknown", .allowed = "front, characteristic"});
}

StressDropIs stress_drop_meaning(std::string_view name) {
  for (const auto meaning : {StressDropIs::static_drop, StressDropIs::stored})
    if (name == name_of(meaning)) return meaning;
  throw InputError({.value = std::string(name), .problem = "unknown", .allowed = "static, stored"});
}

double parse_front_threshold(std::string_view text) {
  const auto value = medium::number(text);
  if (!value || !(*value >= least_front_threshold && *value <= most_front_threshold))
    throw InputError({.value = std::string(text),
                      .problem = value ? "out of range" : "not a number",
                      .allowed = digits(least_front_threshold) + " ... " + digits(most_front_threshold)});
  return *value;
}

}  // namespace slipfront::catalogue
