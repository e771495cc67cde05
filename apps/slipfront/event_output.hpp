#pragma once

#include <string>

#include "slipfront/event/evaluate.hpp"

/// One object of `{"events": [...]}`; null where not identifiable.
std::string event_json(const slipfront::event::EventResult& result);

/// Full-precision CSV with the same names; empty where not identifiable.
std::string event_csv_head();
std::string event_csv_row(const slipfront::event::EventResult& result);

/// A table for people.
std::string event_table_head();
std::string event_table_row(const slipfront::event::EventResult& result);
/// Two lines on the pulse through a finite-fault model, or one with the reason why there is none; nothing if it was
/// not asked for.
std::string event_pulse_lines(const slipfront::event::EventResult& result);
