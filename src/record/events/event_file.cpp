#include "record/events/event_file.hpp"

#include <algorithm>
#include <cstdio>
#include <optional>
#include <utility>

#include "record/events/event_groups.hpp"
#include "record/events/event_layout.hpp"
#include "record/files/fnv.hpp"
#include "record/netcdf/netcdf.hpp"
#include "record/runs/cf.hpp"
#include "results/columns.hpp"
#include "results/serialize.hpp"

namespace slipfront::record {
namespace {

using catalogue::Decade;
using netcdf::Writer;
using results::EventResult;

using Results = std::span<const EventResult>;

/// Collects variables and their values. It writes the values after all variables are defined.
class Contents {
 public:
  explicit Contents(Writer& file) : file_(file) {}

  int reals(const results::NumberColumn& about, const std::vector<int>& dimensions, std::vector<double> values) {
    const int id = file_.reals(about.name, dimensions);
    file_.attribute(id, "long_name", about.long_name);
    file_.attribute(id, "units", about.unit);
    if (!about.reference.empty()) {
      file_.attribute(id, "dimensional_unit", about.dimensional_unit);
      file_.attribute(id, "references", reference_of({{}, {}, {}, about.reference}));
    }
    file_.fill_value(id, none);
    numbers_.emplace_back(id, std::move(values));
    return id;
  }

  void texts(std::string_view name, std::string_view long_name, int dimension, std::vector<std::string> values) {
    const int id = file_.strings(std::string(name), {dimension});
    file_.attribute(id, "long_name", long_name);
    for (std::string& value : values) value = clean_text(value, netcdf::longest_text);
    texts_.emplace_back(id, std::move(values));
  }

  void write() {
    for (const auto& [id, values] : numbers_)
      if (!values.empty()) file_.write_all(id, values);  // NetCDF makes a dimension of size 0 unlimited
    for (const auto& [id, values] : texts_)
      if (!values.empty()) file_.write_all(id, values);
  }

 private:
  Writer& file_;
  std::vector<std::pair<int, std::vector<double>>> numbers_;
  std::vector<std::pair<int, std::vector<std::string>>> texts_;
};

struct Dimensions {
  int event, bound, quantile, draw;
};

Dimensions axes(Writer& file, Contents& contents, std::size_t events, std::size_t draws) {
  const Dimensions d{file.dimension("event", events), file.dimension("bound", 2), file.dimension("quantile", 3),
                     draws > 0 ? file.dimension("draw", draws) : 0};
  contents.texts("bound", "ends of an interval", d.bound, {"5 %", "95 %"});
  contents.reals({"quantile", "share of the values below", "1", "", "", results::Axis::none, 1, {}}, {d.quantile},
                 {0.05, 0.5, 0.95});
  return d;
}

void add_events(Contents& contents, const Dimensions& d, Results results, const results::ColumnChoice& choice) {
  for (const results::NumberColumn& column : results::number_columns(choice)) {
    std::vector<double> values(results.size() * column.count);
    for (std::size_t i = 0; i < results.size(); ++i) column.get(results[i], &values[i * column.count]);
    std::vector<int> dimensions = {d.event};
    if (column.axis == results::Axis::bound) dimensions.push_back(d.bound);
    if (column.axis == results::Axis::quantile) dimensions.push_back(d.quantile);
    if (column.axis == results::Axis::draw) dimensions.push_back(d.draw);
    contents.reals(column, dimensions, std::move(values));
  }
  for (const results::TextColumn& column : results::text_columns(choice.pulse)) {
    std::vector<std::string> values;
    for (const EventResult& r : results) values.push_back(column.get(r));
    contents.texts(column.name, column.long_name, d.event, std::move(values));
  }
}

std::string in_one_line(const std::vector<std::string>& titles) {
  std::string all;
  for (const std::string& title : titles) all += (all.empty() ? "" : ", ") + title;
  return all;
}

void describe_file(Writer& file, const EventMetadata& metadata, bool finished) {
  const auto say = [&](const std::string& name, std::string_view text) {
    file.attribute(Writer::global, name, clean_text(text, netcdf::longest_text));
  };
  for (const auto& [name, text] : file_attributes({.title = "Observed events",
                                  .scenario_text = {},
                                  .version = metadata.version,
                                  .command_line = metadata.command_line,
                                  .x_edges = {},
                                  .variables = {}},
                                                  event_format))
    if (name != "scenario" && name != "comment") say(name, text);
  say("comment",
      "Variables in units of 1 are dimensionless. Multiply them by dimensional_unit, where A is the contact ratio, c "
      "the "
      "speed of strain waves and mu the shear modulus. Values that are not known are NaN.");
  for (const auto& [name, text] : metadata.settings) say(name, text);
  say("ignored_columns", in_one_line(metadata.ignored_columns));
  say("ignored_quantities", in_one_line(metadata.ignored_quantities));
  file.attribute(Writer::global, "finished", finished ? 1 : 0);
}

/// Fills the whole file. `state` holds the results from which an interrupted run resumes.
void fill(Writer& file, const EventMetadata& metadata, Results results, const std::vector<Decade>& population,
          bool finished, const std::string& state) {
  describe_file(file, metadata, finished);
  Contents contents(file);
  const Dimensions d = axes(file, contents, results.size(), metadata.columns.draws);
  add_events(contents, d, results, metadata.columns);
  for (auto& [about, dimensions, values] : event_layout::population_variables(file, population, d.quantile))
    if (const int id = contents.reals(about, dimensions, std::move(values)); about.name == "decade")
      file.attribute(id, "bounds", "decade_bounds");
  const int done =
      file.bytes(event_layout::state, {file.dimension(std::string(event_layout::state) + "_bytes", state.size())});
  file.attribute(done, "long_name", "results of the finished events, from which a run resumes");
  file.attribute(done, "units", "1");
  std::optional<EventGroups> groups;
  if (metadata.columns.draws > 0) groups.emplace(file, metadata.version, results, metadata.columns.draws);
  file.end_definitions();
  contents.write();
  file.write(done, state);
  if (groups) groups->write();
}

}  // namespace

void write_events(const std::string& path, const EventMetadata& metadata, Results results,
                  const std::vector<Decade>& population, bool finished) {
  const std::string state = results::serialize(results);
  const std::size_t size =
      state.size() + results.size() * (1700 + metadata.columns.draws * 8 * (3 * inference::quantities().size() + 7)) +
      (1 << 16);
  write_netcdf(path, size, [&](Writer& file) { fill(file, metadata, results, population, finished, state); });
}

std::string checksum_of_inputs(const std::string& before, std::string_view name, std::string_view content) {
  char text[17];
  std::snprintf(text, sizeof text, "%016llx",
                static_cast<unsigned long long>(Fnv().text(before).text(name).text(content).sum()));
  return text;
}

}  // namespace slipfront::record
