#pragma once

#include <string_view>

#include "scenario/text/section.hpp"
#include "slipfront/medium/quantity.hpp"

namespace slipfront::scenario {

/// The value of a key as a quantity, such as "30 GPa", in SI units. \throws InputError that names the key.
double quantity_in(const Section& section, std::string_view key, const Value& value, medium::Dimension dimension);

}  // namespace slipfront::scenario
