#pragma once
/// \file
/// The file of a catalogue: NetCDF-4 by the CF-1.10 conventions, with the dimension event. It also holds the state from
/// which an unfinished run resumes, and the draws in groups (posterior, prior, posterior_predictive, observed_data and
/// sample_stats), in the layout of ArviZ (InferenceData). The same events as CSV have full precision and the names of
/// `slipfront event --json`; a quantity that cannot be identified has an empty cell.

#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "events/catalogue/population.hpp"
#include "events/results/columns.hpp"
#include "events/results/evaluate.hpp"
#include "runs/record/netcdf/netcdf.hpp"

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

namespace slipfront::record::event_layout {

inline constexpr const char* state = "done";

/// A variable of an event file. Unknown numbers are NaN.
DatasetVariable number(const results::NumberColumn& about, const std::vector<std::string>& dimensions,
                       decltype(DatasetVariable::values) values);
DatasetVariable text(std::string_view name, std::string_view long_name, const std::string& dimension,
                     const std::vector<std::string>& values);

/// Adds the variables of the decades of rupture velocity, with quantiles over the dimension "quantile", and the closed
/// form over these decades, on a separate dimension.
void add_population(Dataset& file, const std::vector<catalogue::Decade>& population);

/// The groups of draws. They refer to `results`. A variable that is NaN for all events is left out, because ArviZ
/// cannot plot it.
std::vector<Dataset> groups_of(std::span<const results::EventResult> results, const std::string& version,
                               std::size_t draws);

}  // namespace slipfront::record::event_layout

namespace slipfront::record {

/// The line of titles, and the line of an event. With `with_pulse` they also have the columns that summarise a pulse
/// through a finite-fault model.
std::string event_csv_head(bool with_pulse);
std::string event_csv_row(const results::EventResult& result, bool with_pulse);

/// Writes a file of these lines completely or not at all. \throws FileError with path and reason.
void write_events_csv(const std::string& path, std::span<const results::EventResult> results, bool with_pulse);

}  // namespace slipfront::record
