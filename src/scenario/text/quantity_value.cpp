#include "scenario/text/quantity_value.hpp"

#include <string>

#include "foundation/text/digits.hpp"

namespace slipfront::scenario {

double quantity_in(const Section& section, std::string_view key, const Value& value, medium::Dimension dimension) {
  const std::string example(medium::example(dimension));
  if (value.kind != Value::Kind::text && value.kind != Value::Kind::number)
    throw section.refuse(key, "neither a number nor a text", example);
  const std::string text = value.kind == Value::Kind::number ? shortest(value.number) : value.text;
  try {
    const medium::Span span = medium::parse_quantity(text, dimension);
    if (span.low < span.high) throw InputError({.problem = "a range, where one number is needed", .allowed = example});
    return span.low;
  } catch (const InputError& error) {
    throw section.refuse(key, error.complaint().problem, error.complaint().allowed);
  }
}

}  // namespace slipfront::scenario
