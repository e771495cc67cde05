// The table [medium] of a scenario.

#include "scenario/settings.hpp"
#include "scenario/text/quantity_value.hpp"
#include "slipfront/medium/constants.hpp"

namespace slipfront::scenario {
void read_medium(const Document& document, medium::Constants& options) {
  const Section section(document, "medium");
  for (const medium::Constant& constant : medium::constants()) {
    const Value* const value = section.find(constant.name);
    if (!value) continue;
    const double quantity = quantity_in(section, constant.name, *value, constant.dimension);
    const bool may_be_negative = constant.name == "poisson_ratio";
    if (may_be_negative && !(quantity > -1 && quantity < 0.5))
      throw section.refuse(constant.name, "out of range", "> -1 and < 0.5");
    if (!may_be_negative && !(quantity > 0)) throw section.refuse(constant.name, "not positive", "> 0");
    options.*constant.member = quantity;
  }
}

}  // namespace slipfront::scenario
