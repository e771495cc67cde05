// The table [loading] of a scenario: springs that pull a chain.

#include <cmath>
#include <optional>
#include <string_view>

#include "scenario/readers.hpp"
#include "scenario/section.hpp"

namespace slipfront::scenario {
namespace {

chain::Pulled pulled_sites(const Section& section) {
  chain::Pulled where = chain::Pulled::everywhere;
  section.read("where", where);
  return where;
}

/// Stiffness of springs that does not vary, in the unit of the model.
double uniform_stiffness(const Section& section) {
  const ModelUnit unit = unit_of_stiffness(section);
  const Value *const value = section.find("stiffness"), *const area = section.find("area");
  if (!area) return *section.number_in("stiffness", unit);
  const double square_metres = section.quantity("area", *area, medium::Dimension::area);
  if (!(square_metres > 0)) throw section.refuse("area", "not positive", "> 0");
  if (!value || value->kind != Value::Kind::text)
    throw section.refuse("area", "it needs a loading.stiffness in N/m", "leave it out, or stiffness = \"1e6 N/m\"");
  const double spring = section.quantity("stiffness", *value, medium::Dimension::spring);
  if (!(spring > 0)) throw section.refuse("stiffness", "not positive", "> 0");
  return spring / square_metres / section.si("stiffness", unit);
}

}  // namespace

ModelUnit unit_of_stiffness(const Section& section) {
  return pulled_sites(section) == chain::Pulled::everywhere ? ModelUnit::stiffness : ModelUnit::end_stiffness;
}

friction::AlongInterface read_springs(const Section& section, const AlongReader& reader, std::string_view key) {
  const bool stiffness = key == "stiffness";
  const Value* const value = section.find(key);
  if (!value && !(stiffness && section.has("area")))
    throw section.refuse(
        key, "missing",
        stiffness ? "> 0: the force of the springs over their stretch" : "a finite number: of the springs' far ends");
  if (!value || !varies(*value)) {
    const double number = stiffness ? uniform_stiffness(section) : *section.number(key);
    return {nullptr, number, number};
  }
  if (stiffness && section.has("area"))
    throw section.refuse("area", "loading.stiffness varies, as a stress over a stretch", "leave it out");
  Limits limits = section.key(key).limits;
  limits.without_least = false;  // a part of the chain may have no springs
  const ModelUnit unit = stiffness ? unit_of_stiffness(section) : ModelUnit::slip_velocity;
  friction::AlongInterface along = reader.in_range(reader.read(key, *value, unit, limits));
  if (stiffness && !(along.most > 0)) throw section.refuse(key, "is 0 everywhere", "> 0 somewhere");
  if (along.at && pulled_sites(section) != chain::Pulled::everywhere)
    throw section.refuse(key, "varies, but the springs pull one end only", "a number, or where = \"everywhere\"");
  return along;
}

void read_loading(const Document& document, const TableReader& tables, Scenario& scenario) {
  const Section section(document, "loading");
  if (!section.has("velocity") && !section.has("where") && !section.has("event_velocity") &&
      !section.has("stiffness") && !section.has("area"))
    return;
  const AlongReader reader(
      section, tables,
      interface_of(document, scenario.domain, trial_range(scenario.domain, scenario.initial.reach, {})));
  chain::Loading& loading = scenario.loading;
  const auto on_line = [](const friction::AlongInterface& along) -> std::function<double(double)> {
    if (!along.at) return nullptr;
    return [at = along.at](double x) { return at(x, 0); };
  };
  const friction::AlongInterface stiffness = read_springs(section, reader, "stiffness");
  const friction::AlongInterface velocity = read_springs(section, reader, "velocity");
  loading.stiffness = stiffness.most;
  loading.stiffness_at = on_line(stiffness);
  loading.velocity = std::fabs(velocity.least) > std::fabs(velocity.most) ? velocity.least : velocity.most;
  loading.velocity_at = on_line(velocity);
  section.read("where", loading.where);
  constexpr double times_loading = 10;
  loading.event_velocity = times_loading * std::fabs(loading.velocity);
  section.read("event_velocity", loading.event_velocity);
}

}  // namespace slipfront::scenario
