#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "command_line.hpp"
#include "slipfront/theory/medium/constants.hpp"
#include "slipfront/theory/medium/si_units.hpp"

/// Options for results in SI units.
struct SiOptions {
  bool si = false;
  std::optional<double> contact_ratio;
  slipfront::medium::StatedDefaults rock;
};

void add_si_options(CommandLine& command, SiOptions& options);

/// The units of results: those of the model, or SI units.
class ResultUnits {
 public:
  /// \throws InputError if the options ask for SI units without a contact ratio.
  explicit ResultUnits(const SiOptions& options);

  bool si() const { return values_.has_value(); }
  /// The factor and the name of a unit of the model, such as "mu A / pi". A pure number has factor 1 and an empty name.
  slipfront::medium::UnitInSi of(std::string_view unit) const;
  /// The unit of each quantity of a table, such as relations_quantities().
  template <class Quantity>
  std::vector<slipfront::medium::UnitInSi> of_each(std::span<const Quantity> quantities) const {
    std::vector<slipfront::medium::UnitInSi> units;
    for (const Quantity& quantity : quantities) units.push_back(of(quantity.about.dimensional_unit));
    return units;
  }

 private:
  std::optional<slipfront::medium::SymbolValues> values_;
};
