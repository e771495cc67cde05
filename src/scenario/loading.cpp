// The table [loading] of a scenario, and a surface without a substrate.

#include <cmath>
#include <string>

#include "scenario/settings.hpp"
#include "scenario/text/section.hpp"

namespace slipfront::scenario {

void read_loading(const Document& document, chain::Loading& loading) {
  const Section section(document, "loading");
  const auto stiffness = section.number("stiffness"), velocity = section.number("velocity");
  const auto where = section.choice<chain::Pulled>(
      "where",
      {{"everywhere", chain::Pulled::everywhere}, {"left", chain::Pulled::left}, {"right", chain::Pulled::right}});
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
