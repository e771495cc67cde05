#pragma once
/// \file
/// The variables in the file of a catalogue that are not columns of the events.
/// The groups in the file of a catalogue that hold draws: posterior, prior, posterior_predictive, observed_data and
/// sample_stats, in the layout of ArviZ (InferenceData).
/// Writes events as CSV, in full precision and with the names of `slipfront event --json`. A quantity that cannot be
/// identified has an empty cell.

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "events/catalogue/population.hpp"
#include "events/results/columns.hpp"
#include "events/results/evaluate.hpp"
#include "runs/record/netcdf/netcdf.hpp"

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
