#pragma once
/// \file
/// A finite-fault model as columns along strike. Private to src/finite_fault.

#include <string>
#include <vector>

#include "finite_fault/along_fault.hpp"

namespace slipfront::finite_fault {

/// The subfaults that lie below one another.
struct FaultColumn {
  double x;             ///< m along strike, from the hypocentre
  double slip;          ///< m, mean over depth, >= 0
  double rupture_time;  ///< s since the rupture began, of the first subfault that slips; NaN if none does
};

struct FaultColumns {
  std::vector<FaultColumn> columns;  ///< ascending in x; none if there is a reason
  double end = 0;                    ///< s since the rupture began, when the last subfault has slipped (TRUP + RISE)
  std::string reason;                ///< one line, why there are no columns
};

/// Of the segment on which the rupture begins. The hypocentre is where its rupture times
/// are least. Subfaults that slip less than 5 % of the largest slip do not count for times.
FaultColumns columns_of(const std::vector<LocalState>& states);

}  // namespace slipfront::finite_fault
