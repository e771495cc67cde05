#pragma once
/// \file
/// Several sources of one earthquake, and what to say where they disagree (docs/events.md).

#include <cstddef>
#include <map>
#include <string>
#include <vector>

#include "slipfront/inference/estimate.hpp"

namespace slipfront::finite_fault {

/// Sources disagree where the largest stress in Pa, or bound of it, is more than this many times the smallest.
inline constexpr double most_disagreement = 2;

/// The stress in Pa that each source of an earthquake means. Two entries are one earthquake if they have the same day
/// and the same first word in their names; where only the year is known, the same year and the same name.
class Sources {
 public:
  /// First all entries of all files, ...
  void add(const catalogue::Observation& observation, const medium::Defaults& defaults);
  /// ... then each again: a warning is added where others of the same earthquake disagree.
  void warn(catalogue::Observation& observation) const;

 private:
  struct Source {
    std::string place;  ///< file and line
    double stress_pa;
  };
  std::map<std::string, std::vector<Source>> by_earthquake_;
};

/// Both, for entries at hand.
void warn_of_other_sources(std::vector<catalogue::Entry>& entries, const medium::Defaults& defaults);

}  // namespace slipfront::finite_fault
