// The table [loading] of a scenario, and a surface without a substrate.

#include <cmath>
#include <string>

#include "scenario/settings.hpp"
#include "scenario/text/section.hpp"

namespace slipfront::scenario {
namespace {

std::optional<chain::Pulled> pulled_sites(const Section& section) {
  return section.choice<chain::Pulled>(
      "where",
      {{"everywhere", chain::Pulled::everywhere}, {"left", chain::Pulled::left}, {"right", chain::Pulled::right}});
}

}  // namespace

ModelUnit unit_of_stiffness(const Section& section) {
  const bool everywhere = pulled_sites(section).value_or(chain::Pulled::everywhere) == chain::Pulled::everywhere;
  return everywhere ? ModelUnit::stiffness : ModelUnit::end_stiffness;
}

std::optional<double> stiffness_of(const Section& section) {
  const ModelUnit unit = unit_of_stiffness(section);
  const Value *const value = section.find("stiffness"), *const area = section.find("area");
  if (!area) return section.number_in("stiffness", unit);
  const double square_metres = section.quantity("area", *area, medium::Dimension::area);
  if (!(square_metres > 0)) throw section.refuse("area", "not positive", "> 0");
  if (!value || value->kind != Value::Kind::text)
    throw section.refuse("area", "it needs a loading.stiffness in N/m", "leave it out, or stiffness = \"1e6 N/m\"");
  const double spring = section.quantity("stiffness", *value, medium::Dimension::spring);
  if (!(spring > 0)) throw section.refuse("stiffness", "not positive", "> 0");
  return spring / square_metres / section.si("stiffness", unit);
}

void read_loading(const Document& document, chain::Loading& loading) {
  const Section section(document, "loading");
  const auto velocity = section.number("velocity");
  const auto where = pulled_sites(section);
  const auto stiffness = stiffness_of(section);
  const auto event_velocity = section.number("event_velocity");
  if (!stiffness && !velocity && !where && !event_velocity) return;
  if (!stiffness) throw section.refuse("stiffness", "missing", "> 0: the force of the springs over their stretch");
  if (!velocity) throw section.refuse("velocity", "missing", "a finite number: of the springs' far ends");
  loading.stiffness = *stiffness;
  loading.velocity = *velocity;
  loading.where = where.value_or(loading.where);
  constexpr double times_loading = 10;
  loading.event_velocity = event_velocity.value_or(times_loading * std::fabs(*velocity));
}

}  // namespace slipfront::scenario
