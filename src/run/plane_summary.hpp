#pragma once
/// \file
/// The numbers that describe a finished run on a plane, with their names, units and errors.

#include <string>
#include <vector>

#include "run/plane.hpp"

namespace slipfront::run {

/// One number, or one for each probe, in the units of the results.
struct PlaneRow {
  std::string key;
  std::vector<double> values;
  std::vector<double> errors;  ///< NaN where it is not known
  std::string unit;            ///< the unit of the model, or the SI unit as UDUNITS reads it; empty for a pure number
  std::string meaning;         ///< with the unit
  bool is_list = false;
  bool is_whole = false;    ///< a count
  std::string reason = {};  ///< why it has no value; empty if it has one
};

struct PlaneSummary {
  std::vector<PlaneRow> rows;
  std::vector<PlaneRow> energies;
  std::vector<PlaneRow> counts;
};

PlaneSummary summary_of(const scenario::Scenario& scenario, const PlaneResult& result, const PlaneNumbers& errors);

}  // namespace slipfront::run
