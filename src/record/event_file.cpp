#include "slipfront/record/event_file.hpp"

#include <algorithm>
#include <cstdio>
#include <utility>

#include "cf.hpp"
#include "event_layout.hpp"
#include "fnv.hpp"
#include "netcdf.hpp"
#include "seal.hpp"
#include "slipfront/event/columns.hpp"
#include "slipfront/event/saved.hpp"
#include "utf8.hpp"
#include "whole_file.hpp"

namespace slipfront::record {
namespace {

using event::Decade;
using event::EventResult;
using netcdf::Writer;

using Results = std::span<const EventResult>;

/// Variables with what is to be written to them once all are defined.
class Contents {
 public:
  explicit Contents(Writer& file) : file_(file) {}

  int reals(const event::NumberColumn& about, const std::vector<int>& dimensions, std::vector<double> values) {
    const int id = file_.reals(about.name, dimensions);
    file_.attribute(id, "long_name", about.long_name);
    file_.attribute(id, "units", about.unit);
    if (!about.reference.empty()) {
      file_.attribute(id, "dimensional_unit", about.dimensional_unit);
      file_.attribute(id, "references", reference_of({{}, {}, {}, about.reference}));
    }
    file_.fill_value(id, event_layout::none);
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
      if (!values.empty()) file_.write_all(id, values);  // a dimension of size 0 is an unlimited one
    for (const auto& [id, values] : texts_)
      if (!values.empty()) file_.write_all(id, values);
  }

 private:
  Writer& file_;
  std::vector<std::pair<int, std::vector<double>>> numbers_;
  std::vector<std::pair<int, std::vector<std::string>>> texts_;
};

struct Dimensions {
  int event, bound, quantile;
};

Dimensions axes(Writer& file, Contents& contents, std::size_t events) {
  const Dimensions d{file.dimension("event", events), file.dimension("bound", 2), file.dimension("quantile", 3)};
  contents.texts("bound", "ends of an interval", d.bound, {"5 %", "95 %"});
  contents.reals({"quantile", "share of the values below", "1", "", "", event::Width::one, {}}, {d.quantile},
                 {0.05, 0.5, 0.95});
  return d;
}

void add_events(Contents& contents, const Dimensions& d, Results results, bool with_pulse) {
  for (const event::NumberColumn& column : event::number_columns(with_pulse)) {
    const auto width = static_cast<std::size_t>(column.width);
    std::vector<double> values(results.size() * width);
    for (std::size_t i = 0; i < results.size(); ++i) column.get(results[i], &values[i * width]);
    std::vector<int> dimensions = {d.event};
    if (column.width == event::Width::bounds) dimensions.push_back(d.bound);
    if (column.width == event::Width::quantiles) dimensions.push_back(d.quantile);
    contents.reals(column, dimensions, std::move(values));
  }
  for (const event::TextColumn& column : event::text_columns(with_pulse)) {
    std::vector<std::string> values;
    for (const EventResult& r : results) values.push_back(column.get(r));
    contents.texts(column.name, column.long_name, d.event, std::move(values));
  }
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
      "Variables in units of 1 are dimensionless; multiply by dimensional_unit: A contact ratio, c speed of strain "
      "waves, mu shear modulus. NaN where not known.");
  for (const auto& [name, text] : metadata.settings) say(name, text);
  file.attribute(Writer::global, "finished", finished ? 1 : 0);
}

}  // namespace

void write_events(const std::string& path, const EventMetadata& metadata, Results results,
                  const std::vector<Decade>& population, bool finished) {
  const std::string state = event::saved(results);
  Writer file(path, state.size() + results.size() * 1500 + (1 << 16));
  describe_file(file, metadata, finished);
  Contents contents(file);
  const Dimensions d = axes(file, contents, results.size());
  add_events(contents, d, results, metadata.with_pulse);
  for (auto& [about, dimensions, values] : event_layout::population_variables(file, population, d.quantile))
    if (const int id = contents.reals(about, dimensions, std::move(values)); about.name == "decade")
      file.attribute(id, "bounds", "decade_bounds");
  const int done =
      file.bytes(event_layout::state, {file.dimension(std::string(event_layout::state) + "_bytes", state.size())});
  file.attribute(done, "long_name", "what the samples and pulses gave, to go on from");
  file.attribute(done, "units", "1");
  file.end_definitions();
  contents.write();
  file.write(done, state);
  const netcdf::Image image = file.finish();
  replace_file(path, {image.bytes(), seal(image.bytes())});
}

std::string checksum_of_inputs(const std::string& before, std::string_view name, std::string_view content) {
  char text[17];
  std::snprintf(text, sizeof text, "%016llx",
                static_cast<unsigned long long>(Fnv().text(before).text(name).text(content).sum()));
  return text;
}

}  // namespace slipfront::record
