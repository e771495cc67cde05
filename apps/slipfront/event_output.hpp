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
