#pragma once
/// \file
/// The variables in the file of a catalogue that are not columns of the events.
/// The groups in the file of a catalogue that hold draws: posterior, prior, posterior_predictive, observed_data and
/// sample_stats, in the layout of ArviZ (InferenceData).
/// Writes events as CSV, in full precision and with the names of `slipfront event --json`. A quantity that cannot be
/// identified has an empty cell.

#include <cstdint>
#include <deque>
#include <functional>
#include <limits>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "events/catalogue/population.hpp"
#include "events/results/columns.hpp"
#include "events/results/evaluate.hpp"
#include "math/constants.hpp"
#include "runs/record/netcdf/netcdf.hpp"

namespace slipfront::record::event_layout {

inline constexpr const char* state = "done";

/// A variable of numbers with its values. `about.get` is not used.
struct Variable {
  results::NumberColumn about;
  std::vector<int> dimensions;
  std::vector<double> values;
};

/// The variables of the decades of rupture velocity, with quantiles over the dimension `quantile` of the file. It also
/// has the closed form over these decades, on a separate dimension.
std::vector<Variable> population_variables(netcdf::Writer& file, const std::vector<catalogue::Decade>& population,
                                           int quantile);

}  // namespace slipfront::record::event_layout

namespace slipfront::record {

/// Defines the groups when it is made, and writes their values after the definitions of the file have ended. Its
/// arguments must outlive it. A variable that is NaN for all events is left out, because ArviZ cannot plot it.
class EventGroups {
 public:
  EventGroups(const netcdf::Writer& file, const std::string& version, std::span<const results::EventResult> results,
              std::size_t draws);
  void write();

 private:
  using Result = results::EventResult;
  struct Group {
    Group(const netcdf::Writer& parent, const std::string& name) : file(parent, name) {}
    netcdf::Writer file;
    int chain = 0, draw = 0, event = 0;
    std::vector<std::pair<int, std::function<std::vector<double>()>>> numbers = {};
    std::vector<std::pair<int, std::vector<std::int64_t>>> positions = {};
    int names = 0;
  };

  Group& add_group(const netcdf::Writer& file, const std::string& name, std::string_view about, bool has_draws);
  void add_states(Group& group, std::vector<inference::FaultState> inference::Posterior::*states);
  void add_repeated(Group& group);
  void add_observed(Group& group);
  void add_statistics(Group& group);
  /// Adds a variable over chain, draw and event, unless it has no values.
  void add_draws(Group& group, const results::NumberColumn& about,
                 const std::function<double(const Result&, std::size_t)>& get);
  void add_events(Group& group, const results::NumberColumn& about, const std::function<double(const Result&)>& get);

  const std::string& version_;
  std::span<const Result> results_;
  std::size_t draws_;
  std::deque<Group> groups_;
};

/// The line of titles, and the line of an event. With `with_pulse` they also have the columns that summarise a pulse
/// through a finite-fault model.
std::string event_csv_head(bool with_pulse);
std::string event_csv_row(const results::EventResult& result, bool with_pulse);

/// Writes a file of these lines completely or not at all. \throws FileError with path and reason.
void write_events_csv(const std::string& path, std::span<const results::EventResult> results, bool with_pulse);

}  // namespace slipfront::record
