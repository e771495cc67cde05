#pragma once

#include <optional>
#include <string>

#include "events/results/columns.hpp"
#include "runs/catalogue.hpp"
#include "terminal_table.hpp"

/// One object of `{"events": [...]}`. Quantities that are not identifiable are null.
std::string event_json(const slipfront::results::EventResult& result);

/// The keys about columns that were not read: `ignored_columns`, `ignored_quantities`, and `tables` with those of each
/// file. Without the braces of an object.
std::string columns_json(const slipfront::run::CatalogueColumns& columns);

/// Text of a slip velocity: "2.8 m/s", "0.3 mm/day", "-".
std::string speed_text(const std::optional<double>& metres_per_second);
/// Text of the velocity of a rupture front. Slow fronts are in km/day.
std::string front_text(const std::optional<double>& metres_per_second);

/// A table with one line per event, and below it the ends of the intervals, if there are any.
TerminalTable event_table_head();
TerminalTable event_table_row(const slipfront::results::EventResult& result);
/// One event as a short report in sentences. Empty if it has an error.
std::string event_report(const slipfront::results::EventResult& result);
/// Adds two lines about the pulse through a finite-fault model, or one line with the reason why there is no pulse. Adds
/// nothing if the user did not request a pulse.
void add_event_pulse(TerminalTable& table, const slipfront::results::EventResult& result);
