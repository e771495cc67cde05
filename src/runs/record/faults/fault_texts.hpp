#pragma once
/// \file
/// A kinematic source as text: .fsp, and CSV of subfaults.

#include <string>

#include "events/catalogue/fault_model.hpp"
#include "events/finite_fault/source/source.hpp"

namespace slipfront::record {

/// A source and the event that it was made of, which has name, date and velocities.
struct DescribedSource {
  const finite_fault::FiniteSource& source;
  const catalogue::Observation& event;
};

/// The layout of SRCMOD. The velocity table has a layer for each depth, with the shear modulus that keeps the moment.
std::string fsp_text(const DescribedSource& described, const std::string& history);

/// One subfault a row, in SI units. Positions are the middles of upper edges, as GeoClaw reads them by default.
std::string subfaults_csv(const finite_fault::FiniteSource& source);

}  // namespace slipfront::record
