#pragma once
/// \file
/// Divides a finite-fault model into columns along strike. Private to src/finite_fault.

#include <string>
#include <vector>

#include "finite_fault/along_fault.hpp"

namespace slipfront::finite_fault {

/// A column: the subfaults at one position along strike.
struct FaultColumn {
  double x;             ///< m along strike, from the hypocentre
  double slip;          ///< m, mean over depth, >= 0
  double rupture_time;  ///< s since the rupture began, at the first subfault that slips; NaN if none does
};

struct FaultColumns {
  std::vector<FaultColumn> columns;  ///< ascending in x; empty if there is a `reason`
  double end = 0;                    ///< s since the rupture began, when the last subfault has slipped (TRUP + RISE)
  std::string reason;                ///< one line that states why there are no columns
};

/// The columns of the segment on which the rupture begins. The hypocentre is the position of the earliest rupture
/// times. Rupture times of subfaults that slip less than 5 % of the largest slip are ignored.
FaultColumns columns_of(const std::vector<LocalState>& states);

}  // namespace slipfront::finite_fault
