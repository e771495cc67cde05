#pragma once
/// \file
/// Text formats of observed events. The readers take text, not paths: record/ knows files.

#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "slipfront/events/catalogue/observation.hpp"

namespace slipfront::catalogue {

/// One event from a TOML text: tables [event] and [medium], quantities as "3.0 km/s". See docs/events.md.
/// \throws InputError naming line, key and value.
Observation read_toml(std::string_view text, const std::string& file);

/// Takes the entries of a file one by one, in the file's order.
using Sink = std::function<void(Entry&&)>;

/// How a table is to be read.
struct TableOptions {
  std::string map = {};       ///< TOML text that maps titles to quantities (docs/events.md); by default none
  std::string map_file = {};  ///< its file, for error messages
  /// Whether the rows are fronts in the laboratory, with shear and normal stress, instead of events.
  bool of_fronts = false;
  std::vector<std::string> required = {};  ///< quantities that each row must have
};

/// Reads the map of the options and discards it. \throws InputError with file and line, if the map is wrong.
void check_column_map(const TableOptions& options);

/// Notes about a table as a whole.
struct TableNotes {
  std::vector<std::string> ignored = {};             ///< titles of the columns that give no observation
  std::vector<std::string> ignored_quantities = {};  ///< those of them that look like quantities
  std::vector<std::string> notes = {};               ///< other notes, with file and line
};

/// A CSV catalogue, one event a row, as published: units in the header (`rupture_velocity_km_s`, `VR [km/s]`), below it
/// or in the cell; columns of errors; comments and a preamble before the header; commas, tabs or semicolons. A bad row
/// becomes an entry with an error. \throws InputError when the text as a whole is unusable, or the map is wrong.
TableNotes read_csv(std::string_view text, const std::string& file, const Sink& sink, const TableOptions& options = {});

/// The meaning that a reader gives to one column of a table.
struct ColumnDescription {
  std::string title = {};
  std::string meaning = {};     ///< as in a map, such as "error of slip" or "name"; empty if the column is not used
  std::string unit = {};        ///< unit of the cells; empty if they have none, or each has its own
  double deviations = 0;        ///< an error is this many standard deviations
  std::string reason = {};      ///< why the column is not used, or cannot be read
  bool looks_physical = false;  ///< a column that is not understood, and looks like a quantity
};

struct TableDescription {
  std::string file = {};
  std::size_t header_line = 0;  ///< 0 if no line has titles
  char separator = ',';         ///< between the cells of a row; ' ' for any number of blanks
  bool decimal_comma = false;
  std::vector<ColumnDescription> columns = {};
  std::string map = {};  ///< TOML text for TableOptions, to edit
};

/// Describes a CSV table by its header. \throws InputError when the text is none, or the map is wrong.
TableDescription describe_table(std::string_view text, const std::string& file, const TableOptions& options = {});

/// A finite-fault model in SRCMOD / USGS .fsp text format: rupture velocity from avVr, slip velocity from the
/// area-weighted mean slip over avTr (or over the slip-weighted mean RISE), elastic constants from the velocity table
/// at the hypocentre. Sentinels (0, -99, 999, blank) are absences, never values. \throws InputError when the text is
/// cut, empty or not such a model.
Observation read_fsp(std::string_view text, const std::string& file);

/// Any of the formats, by the ending of `file` (.toml, .csv, .fsp, .json), else by what the text looks like. Never
/// throws InputError: what is unusable as a whole becomes an entry with an error.
TableNotes read_events(std::string_view text, const std::string& file, const Sink& sink,
                       const TableOptions& options = {});

}  // namespace slipfront::catalogue
