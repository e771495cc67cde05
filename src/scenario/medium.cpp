// The table [medium] of a scenario.

#include "section.hpp"
#include "settings.hpp"
#include "slipfront/medium/constants.hpp"

namespace slipfront::scenario {
namespace {

double read_quantity(const Section& section, const Value& value, const medium::Constant& constant) {
  const std::string example(medium::example(constant.dimension));
  if (value.kind != Value::Kind::text && value.kind != Value::Kind::number)
    throw section.refuse(constant.name, "neither a number nor a text", example);
  const std::string text = value.kind == Value::Kind::number ? shortest(value.number) : value.text;
  try {
    const medium::Span span = medium::parse_quantity(text, constant.dimension);
    if (span.low < span.high) throw InputError({.problem = "a range, where one number is needed", .allowed = example});
    return span.low;
  } catch (const InputError& error) {
    throw section.refuse(constant.name, error.complaint().problem, error.complaint().allowed);
  }
}

}  // namespace

void read_medium(const Document& document, medium::Constants& options) {
  std::vector<std::string_view> names;
  for (const medium::Constant& constant : medium::constants()) names.push_back(constant.name);
  const Section section(document, "medium", names);
  for (const medium::Constant& constant : medium::constants()) {
    const Value* const value = section.find(constant.name);
    if (!value) continue;
    const double quantity = read_quantity(section, *value, constant);
    const bool may_be_negative = constant.name == "poisson_ratio";
    if (may_be_negative && !(quantity > -1 && quantity < 0.5))
      throw section.refuse(constant.name, "out of range", "> -1 and < 0.5");
    if (!may_be_negative && !(quantity > 0)) throw section.refuse(constant.name, "not positive", "> 0");
    options.*constant.member = quantity;
  }
}

}  // namespace slipfront::scenario
