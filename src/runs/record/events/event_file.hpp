#pragma once
/// \file
/// The file of a catalogue: NetCDF-4 by the CF-1.10 conventions, with the dimension event. It also holds the state from
/// which an unfinished run resumes.

#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "events/catalogue/population.hpp"
#include "events/results/columns.hpp"
#include "events/results/evaluate.hpp"

namespace slipfront::record {

inline constexpr const char* event_format = "event 3";  ///< value of the attribute slipfront_format

/// The attributes of the file of a catalogue.
struct EventMetadata {
  std::string version;       ///< version of slipfront
  std::string command_line;  ///< stored as the file's history
  /// Names and values of the settings that determine the results, such as seed and samples.
  std::vector<std::pair<std::string, std::string>> settings;
  results::ColumnChoice columns = {};
  std::vector<std::string> ignored_columns = {};     ///< titles of columns of the input that were not used
  std::vector<std::string> ignored_quantities = {};  ///< those of them that look like quantities
};

/// Writes the columns of `results`, their population and the closed form to `path`, completely or not at all. Equal
/// arguments give files that are equal byte by byte. \throws FileError (one line: path and reason).
void write_events(const std::string& path, const EventMetadata& metadata, std::span<const results::EventResult> results,
                  const std::vector<catalogue::Decade>& population, bool finished);

/// Reads the finished events of a file by write_events, in the form for results::deserialize. They are the first events
/// of the catalogue. \throws FileError if the file is missing, not of a catalogue, truncated, damaged, or changed by
/// another program. \throws InputError if its version or one of its settings differs from `metadata`.
std::string read_events_done(const std::string& path, const EventMetadata& metadata);

/// A checksum of the input files of a catalogue. It combines the checksum `before` of the previous files with the name
/// and the content of the next one.
std::string checksum_of_inputs(const std::string& before, std::string_view name, std::string_view content);

}  // namespace slipfront::record
