#pragma once
/// \file
/// The file of a catalogue: NetCDF-4 by the CF-1.10 conventions, dimension event, and what it takes to go on with an
/// unfinished one.

#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "catalogue/population.hpp"
#include "results/columns.hpp"
#include "results/evaluate.hpp"

namespace slipfront::record {

inline constexpr const char* event_format = "event 2";  ///< slipfront_format

/// What the file of a catalogue says besides the events.
struct EventMetadata {
  std::string version;       ///< of slipfront
  std::string command_line;  ///< the file's history
  /// Attributes that make the results what they are, such as seed and samples: names and values.
  std::vector<std::pair<std::string, std::string>> settings;
  results::ColumnChoice columns = {};
};

/// Writes `path` whole or not at all: the columns of `results`, their population and the closed form. Equal arguments
/// make equal files, byte by byte. \throws FileError (one line: path and reason).
void write_events(const std::string& path, const EventMetadata& metadata, std::span<const results::EventResult> results,
                  const std::vector<catalogue::Decade>& population, bool finished);

/// What write_events was given that results::deserialize understands: of the first events of a catalogue, as many as
/// were done. \throws FileError if the file is not there, not of a catalogue, cut short, damaged, or changed by another
/// program; InputError if its version or one of its settings is not that of `metadata`.
std::string read_events_done(const std::string& path, const EventMetadata& metadata);

/// A checksum of what a catalogue is read from: of the files before, and the next one's name and content.
std::string checksum_of_inputs(const std::string& before, std::string_view name, std::string_view content);

}  // namespace slipfront::record
