#pragma once

#include <optional>
#include <string>

#include "results/columns.hpp"

/// One object of `{"events": [...]}`; null where not identifiable.
std::string event_json(const slipfront::results::EventResult& result);

/// Full-precision CSV with the same names; empty where not identifiable. What a pulse through a finite-fault model is
/// summed up by has columns of its own `with_pulse`.
std::string event_csv_head(bool with_pulse);
std::string event_csv_row(const slipfront::results::EventResult& result, bool with_pulse);

/// "2.8 m/s", "0.3 mm/day", "-".
std::string speed_text(const std::optional<double>& metres_per_second);
/// The same of a rupture front: slow ones in km/day.
std::string front_text(const std::optional<double>& metres_per_second);

/// A table for people: a line an event, and below it the ends of the intervals, where there are any.
std::string event_table_head();
std::string event_table_row(const slipfront::results::EventResult& result);
/// Two lines on the pulse through a finite-fault model, or one with the reason why there is none; nothing if it was
/// not asked for.
std::string event_pulse_lines(const slipfront::results::EventResult& result);
