#pragma once
/// \file
/// The columns of a finite-fault model along strike, and several sources of one earthquake, with what to say where they
/// disagree (docs/events.md).

#include <string>
#include <vector>

#include "events/finite_fault/along_fault.hpp"
#include "slipfront/events/inference/estimate.hpp"

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

/// Sources disagree where the largest stress in Pa, or bound of it, is more than this many times the smallest.
inline constexpr double most_disagreement = 2;

/// Adds a warning to each entry where sources of its earthquake disagree. Two entries are one earthquake if they have
/// the same folder; or the same day and the same first word in their names; where only the year is known, the same year
/// and the same name.
void warn_of_other_sources(std::vector<catalogue::Entry>& entries, const medium::Defaults& defaults);

}  // namespace slipfront::finite_fault
