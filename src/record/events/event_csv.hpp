#pragma once
/// \file
/// Writes events as CSV, in full precision and with the names of `slipfront event --json`. A quantity that cannot be
/// identified has an empty cell.

#include <span>
#include <string>

#include "results/evaluate.hpp"

namespace slipfront::record {

/// The line of titles, and the line of an event. With `with_pulse` they also have the columns that summarise a pulse
/// through a finite-fault model.
std::string event_csv_head(bool with_pulse);
std::string event_csv_row(const results::EventResult& result, bool with_pulse);

/// Writes a file of these lines completely or not at all. \throws FileError with path and reason.
void write_events_csv(const std::string& path, std::span<const results::EventResult> results, bool with_pulse);

}  // namespace slipfront::record
