#pragma once
/// \file
/// Three text formats of observed events. The readers take text, not paths: record/ knows files.

#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "slipfront/catalogue/observation.hpp"

namespace slipfront::catalogue {

/// One event from a TOML text: tables [event] and [medium], quantities as "3.0 km/s". See docs/events.md.
/// \throws InputError naming line, key and value.
Observation read_toml(std::string_view text, const std::string& file);

/// Takes the entries of a file one by one, in the file's order: a catalogue of a million rows is never held whole.
using Sink = std::function<void(Entry&&)>;

/// A CSV catalogue, one event a row, units in the header (`rupture_velocity_km_s`, `slip_velocity [m/s]`) or in the
/// cell. A bad row becomes an entry with an error. Returns the columns that carry no observation. \throws InputError
/// when the text as a whole is unusable.
std::vector<std::string> read_csv(std::string_view text, const std::string& file, const Sink& sink);

/// A finite-fault model in SRCMOD / USGS .fsp text format: rupture velocity from avVr, slip velocity from the
/// area-weighted mean slip over avTr (or over the slip-weighted mean RISE), elastic constants from the velocity table
/// at the hypocentre. Sentinels (0, -99, 999, blank) are absences, never values. \throws InputError when the text is
/// cut, empty or not such a model.
Observation read_fsp(std::string_view text, const std::string& file);

/// Any of the three, by the ending of `file` (.toml, .csv, .fsp), else by what the text looks like. Never throws
/// InputError: what is unusable as a whole becomes an entry with an error. Returns the columns of a CSV that carry no
/// observation.
std::vector<std::string> read_events(std::string_view text, const std::string& file, const Sink& sink);

}  // namespace slipfront::catalogue
