#pragma once
/// \file
/// What was observed of one slip event, in SI units, before any theory is applied.

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "slipfront/error.hpp"
#include "slipfront/medium/constants.hpp"

namespace slipfront::event {

/// A measured quantity in SI units; low == high for a single number, else the published range (read as uniform).
struct Measured {
  double low = 0;
  double high = 0;
  double middle() const { return low + (high - low) / 2; }
  bool is_range() const { return low < high; }
};

/// One event as its file gives it. Everything is optional but the name: absent means not observed.
struct Observation : medium::Constants {
  std::string name;
  std::string date;
  std::string kind;      ///< "earthquake", "slow slip", ... free text
  std::string citation;  ///< published source of the numbers
  std::string note;      ///< what the source says to mind, free text
  std::string file;      ///< where it was read
  std::size_t line = 0;  ///< line of the row, table or header in that file

  std::optional<Measured> rupture_velocity;  ///< m/s
  std::optional<Measured> slip_velocity;     ///< m/s
  std::optional<Measured> slip;              ///< m
  std::optional<Measured> rise_time;         ///< s, time that one point slips
  std::optional<Measured> duration;          ///< s, of the whole event

  std::vector<std::string> warnings;  ///< what the reader had to assume or leave out
};

/// One entry of a file: an observation, or the reason why it is none. A bad entry does not lose its neighbours.
struct Entry {
  Observation observation;
  std::optional<Complaint> error;
};

}  // namespace slipfront::event
