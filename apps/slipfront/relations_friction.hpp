#pragma once

#include <string>
#include <vector>

#include "commands.hpp"
#include "slipfront/theory/medium/si_units.hpp"
#include "slipfront/theory/rupture/relations.hpp"

/// Options of `relations` for friction. With them it computes C from a ratio of slip velocities, or the ratio from C,
/// for both closures. The paper reads these numbers from its Fig. 10.
struct FrictionOptions {
  std::vector<double> ratios;        ///< W over the frictionless W(0)
  std::vector<double> coefficients;  ///< C of f = C w
  double time = 6.283185307179586;   ///< T, in b / (c A); only C T matters
  std::string measure = "origin";    ///< which slip velocity, see docs/friction_ratio.md

  bool wanted() const { return !ratios.empty() || !coefficients.empty(); }
};

void add_friction_options(CommandLine& command, FrictionOptions& options);

/// The unit of each of relations_quantities() in the results.
struct RelationsUnits {
  bool si = false;
  std::vector<slipfront::medium::UnitInSi> each;
};

/// Prints one row for each state, ratio or coefficient, and closure. \throws InputError.
void print_friction(const std::vector<slipfront::rupture::Relations>& states, const FrictionOptions& friction,
                    const RelationsUnits& units, const CommonOptions& options);
