// The table [friction] of a scenario.

#include "section.hpp"
#include "settings.hpp"

namespace slipfront::scenario {

using modulation::Closure;
using modulation::FrictionLaw;

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
