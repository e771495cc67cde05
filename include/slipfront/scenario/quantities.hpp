#pragma once
/// \file
/// The numbers of a scenario in the units of the model and in SI units.

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "slipfront/scenario/scenario.hpp"
#include "slipfront/theory/medium/constants.hpp"

namespace slipfront::scenario {

/// One unit of the model.
struct Scale {
  std::string_view name;     ///< the quantity that has this unit
  std::string_view symbol;   ///< the unit, such as "b / A"
  std::optional<double> si;  ///< its value; absent if [medium] does not determine it
  std::string_view si_unit;
};

/// The units of position, time, slip, slip velocity, stress, force and stiffness.
std::vector<Scale> scales_of(const medium::Constants& medium);

/// A number that a scenario file gives, or one item of a list.
struct Quantity {
  std::string key;   ///< "table.key"
  std::string text;  ///< as in the file
  double model;      ///< in the unit of the model
  std::string_view unit;
  std::optional<double> si;  ///< absent if [medium] does not determine it
  std::string_view si_unit;
};

/// The numbers with a dimension that a scenario file gives; of a parameter that varies the least and the largest value.
/// \throws InputError like read_scenario.
std::vector<Quantity> quantities_of(std::string_view text, const std::string& file,
                                    const std::vector<std::string>& overrides, const TableReader& tables = {});

}  // namespace slipfront::scenario
