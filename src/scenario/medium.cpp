// The table [medium] of a scenario.

#include "scenario/settings.hpp"
#include "scenario/text/section.hpp"
#include "slipfront/medium/constants.hpp"

namespace slipfront::scenario {
void read_medium(const Document& document, medium::Constants& options) {
  const Section section(document, "medium");
  Errors errors;
  for (const medium::Constant& constant : medium::constants()) {
    const Value* const value = section.find(constant.name);
    if (!value) continue;
    errors.attempt([&] {
      const double quantity = section.quantity(constant.name, *value, constant.dimension);
      const Key& key = section.key(constant.name);
      if (!key.limits.hold(quantity))
        throw section.refuse(constant.name, key.limits.least < 0 ? "out of range" : "not positive", key.allowed());
      options.*constant.member = quantity;
    });
  }
  errors.throw_if_any();
}

}  // namespace slipfront::scenario
