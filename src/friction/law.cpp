#include "slipfront/friction/law.hpp"

#include <cmath>
#include <string>

#include "math/roots.hpp"
#include "slipfront/error.hpp"

namespace slipfront::friction {
namespace {

class NoState final : public StateEvolution {
 public:
  void start(std::span<double>) const override {}
  void advance(const Slip&, double, std::span<double>) const override {}
  void advance_all(std::size_t, const Slips&, double, EvolvingStates) const override {}
};

}  // namespace

const char* name_of(Closure closure) { return closure == Closure::paper ? "paper" : "consistent"; }

Closure closure_named(std::string_view name) {
  for (const Closure c : {Closure::consistent, Closure::paper})
    if (name == name_of(c)) return c;
  throw InputError(
      {.key = "closure", .value = std::string(name), .problem = "unknown", .allowed = "consistent, paper"});
}

Parameter coefficient_in(std::string_view unit) {
  return {.name = "coefficient",
          .symbol = "C",
          .unit = unit,
          .meaning = "factor of the force",
          .dimension = Dimension::force,
          .if_missing = "counts as 0: there is no friction"};
}

Parameter strength_in(std::string_view unit, std::string_view symbol, std::string_view meaning) {
  Parameter strength = coefficient_in(unit);
  strength.name = "strength";
  strength.symbol = symbol;
  strength.meaning = meaning;
  strength.if_missing = "counts as 0";
  return strength;
}

Parameter force_named(std::string_view name, std::string_view symbol, std::string_view meaning, double value) {
  return {.name = name,
          .symbol = symbol,
          .unit = force_unit,
          .meaning = meaning,
          .value = value,
          .dimension = Dimension::force};
}

Parameter velocity_named(std::string_view name, std::string_view symbol, std::string_view meaning) {
  return {.name = name,
          .symbol = symbol,
          .unit = "c A / pi",
          .meaning = meaning,
          .value = 1,
          .without_least = true,
          .dimension = Dimension::velocity};
}

Parameter characteristic_slip() {
  return {.name = "characteristic_slip",
          .symbol = "D_c",
          .unit = "b / (2 pi)",
          .meaning = "slip that renews the contacts, or over which friction weakens",
          .value = 1,
          .without_least = true,
          .dimension = Dimension::slip};
}

const Parameter* Definition::find(std::string_view parameter) const {
  for (const Parameter& p : parameters)
    if (p.name == parameter) return &p;
  return nullptr;
}

void StateEvolution::advance_all(std::size_t size, const Slips& slips, double time, EvolvingStates states) const {
  for (std::size_t i = 0; i < size; ++i) {
    LocalValues here = states.at(i);
    advance({slips.mean[i], slips.typical[i]}, time, here);
    for (std::size_t v = 0; v < states.each; ++v) states(i, v) = here[v];
  }
}

const StateEvolution& Law::evolution() const {
  static const NoState none;
  return none;
}

/// The root lies in [0, free], as f >= 0.
double Law::speed_after(double free, double weight, LocalState state) const {
  const auto excess = [&](double v) { return v + weight * strength(v, state) - free; };
  Bracket root{.low = 0, .high = free, .at_low = excess(0), .at_high = excess(free)};
  if (root.at_low >= 0) return 0;
  root.x = free - root.at_high;  // a good guess, as the force changes little in a step
  root.keep_inside();
  return root_of(root, 2e-16 * free, 2e-16, 0, excess);
}

}  // namespace slipfront::friction
