#pragma once

#include <optional>
#include <string>

#include "slipfront/event/estimate.hpp"
#include "slipfront/event/read.hpp"

/// One event of a file, after the theory: an estimate or the reason why there is none.
struct EventResult {
  slipfront::event::Observation observation;
  std::optional<slipfront::event::Estimate> estimate;
  std::string error;  ///< one line; empty when there is an estimate

  const std::vector<std::string>& warnings() const { return estimate ? estimate->warnings : observation.warnings; }
};

/// One object of `{"events": [...]}`; null where not identifiable.
std::string event_json(const EventResult& result);

/// Full-precision CSV with the same names; empty where not identifiable.
std::string event_csv_head();
std::string event_csv_row(const EventResult& result);

/// A table for people.
std::string event_table_head();
std::string event_table_row(const EventResult& result);
