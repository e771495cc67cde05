#pragma once

#include "scenario/text/section.hpp"
#include "slipfront/scenario/scenario.hpp"

namespace slipfront::scenario {

// Each function reads and checks its table. Missing keys retain their defaults. \throws InputError.

void read_friction(const Document& document, const TableReader& tables, Scenario& scenario);
void read_medium(const Document& document, medium::Constants& medium);
void read_domain(const Document& document, Domain& domain);
void read_pulse(const Document& document, PulseOptions& pulse);
void read_chain(const Document& document, ChainOptions& chain);
/// Stiffness of the springs in the unit of the model, and that unit, which depends on the sites that they pull.
std::optional<double> stiffness_of(const Section& section);
ModelUnit unit_of_stiffness(const Section& section);
void read_loading(const Document& document, chain::Loading& loading);
double read_end(const Document& document, double otherwise);
Output read_output(const Document& document, double end);

}  // namespace slipfront::scenario
