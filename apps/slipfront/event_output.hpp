#pragma once

#include <optional>
#include <string>

#include "slipfront/event/along_fault.hpp"
#include "slipfront/event/posterior.hpp"
#include "slipfront/event/read.hpp"

/// One event of a file, after the theory: an estimate or the reason why there is none.
struct EventResult {
  slipfront::event::Observation observation;
  std::optional<slipfront::event::Estimate> estimate;
  std::optional<slipfront::event::Posterior> posterior;   ///< where the event was sampled
  std::vector<slipfront::event::LocalState> along_fault;  ///< of a finite-fault model, for --json
  std::string error;                                      ///< one line; empty when there is an estimate

  /// Those of the closed forms, then what the samples say.
  std::vector<std::string> warnings() const {
    std::vector<std::string> all = estimate ? estimate->warnings : observation.warnings;
    if (posterior) all.insert(all.end(), posterior->notes.begin(), posterior->notes.end());
    return all;
  }
};

/// One object of `{"events": [...]}`; null where not identifiable.
std::string event_json(const EventResult& result);

/// Full-precision CSV with the same names; empty where not identifiable.
std::string event_csv_head();
std::string event_csv_row(const EventResult& result);

/// A table for people.
std::string event_table_head();
std::string event_table_row(const EventResult& result);
