// The tables that say what the interface is made of: [friction] and [medium].

#include "section.hpp"
#include "settings.hpp"
#include "slipfront/medium/constants.hpp"

namespace slipfront::scenario {
namespace {

using modulation::Closure;
using modulation::FrictionLaw;

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

void read_friction(const Document& document, Scenario& scenario) {
  const Section section(document, "friction", {"law", "coefficient", "exponent", "closure"});
  modulation::Friction& friction = scenario.friction;
  const auto law = section.choice<FrictionLaw>("law", {{"none", FrictionLaw::none},
                                                       {"viscous", FrictionLaw::viscous},
                                                       {"coulomb", FrictionLaw::coulomb},
                                                       {"power", FrictionLaw::power}});
  friction.law = law.value_or(friction.law);
  friction.coefficient = section.number("coefficient", not_negative).value_or(friction.coefficient);
  const Limits exponents{.least = 0, .most = 20, .without_least = true};
  friction.exponent = section.number("exponent", exponents).value_or(friction.exponent);
  friction.closure =
      section.choice<Closure>("closure", {{"consistent", Closure::consistent}, {"paper", Closure::paper}})
          .value_or(friction.closure);
  // A key without effect is a misunderstanding, better said now than found in the results.
  for (const std::string_view key : {"coefficient", "exponent"})
    if (section.has(key) && !law)
      throw section.refuse(key, "friction.law is missing", "with law = \"viscous\", \"coulomb\" or \"power\"");
  if (section.has("coefficient") && friction.law == FrictionLaw::none)
    throw section.refuse("coefficient", "contradicts law = \"none\"", "leave it out, or change friction.law");
  if (section.has("exponent") && friction.law != FrictionLaw::power)
    throw section.refuse("exponent", "contradicts friction.law, which has no exponent", "with law = \"power\"");
  if (friction.law != FrictionLaw::none && !section.has("coefficient"))
    scenario.warnings.push_back("friction.coefficient is not given and counts as 0: there is no friction");
}

}  // namespace slipfront::scenario
