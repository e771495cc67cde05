#include "runs/record/events/event_file.hpp"

#include <algorithm>
#include <cstdio>
#include <optional>
#include <string>
#include <utility>

#include "events/results/columns.hpp"
#include "events/results/evaluate.hpp"
#include "runs/record/arrays.hpp"
#include "runs/record/events/event_groups.hpp"
#include "runs/record/netcdf/netcdf.hpp"
#include "slipfront/error.hpp"
#include "system/files/seal.hpp"
#include "system/files/whole_file.hpp"

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
  for (const auto& [name, text] : file_attributes({.format = event_format,
                                  .title = "Observed events",
                                  .scenario_text = {},
                                  .version = metadata.version,
                                  .command_line = metadata.command_line}))
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

namespace {

std::string done_in(const netcdf::Reader& file, const std::string& path, const EventMetadata& metadata) {
  const auto fail = [&](const std::string& reason) {
    throw FileError(path + ": not a catalogue to resume from: " + reason);
  };
  const std::string format = file.text("slipfront_format").value_or("");
  if (format != event_format)
    fail("its slipfront_format is '" + format.substr(0, 40) + "'; this version reads '" + event_format + "'");
  const auto require = [&](const std::string& name, const std::string& wanted) {
    const auto written = file.text(name);
    if (!written) fail("attribute " + name + " is missing");
    if (*written == clean_text(wanted, netcdf::longest_text)) return;
    throw InputError({.file = path,
                      .key = "resume",
                      .value = *written,
                      .problem = name == "input_checksum" ? "was written from other files or contents"
                                                          : "was written with another " + name,
                      .allowed = "go on as it was begun, here it is '" + wanted + "'"});
  };
  require("version", metadata.version);
  for (const auto& [name, text] : metadata.settings) require(name, text);
  const auto done = file.find(event_layout::state);
  if (!done || done->shape.size() != 1) fail(std::string("variable ") + event_layout::state + " is missing");
  return file.bytes(*done);
}

}  // namespace

std::string read_events_done(const std::string& path, const EventMetadata& metadata) {
  const std::string content = read_regular(path);
  const std::string_view image = sealed_content(content, path);
  return done_in(netcdf::Reader(path, image, image.size()), path, metadata);
}

}  // namespace slipfront::record

namespace slipfront::record::event_layout {
namespace {

using catalogue::Decade;
using results::Axis;
using results::NumberColumn;

NumberColumn described(const std::string& name, const std::string& long_name, std::string_view dimensional_unit,
                       std::string_view reference, std::string_view unit = "1") {
  return {name, long_name, unit, dimensional_unit, reference, Axis::none, 1, {}};
}

template <class Row, class Get>
std::vector<double> each(const std::vector<Row>& rows, Get&& get) {
  std::vector<double> values;
  values.reserve(rows.size());
  for (const Row& row : rows) values.push_back(static_cast<double>(get(row)));
  return values;
}

/// Adds the quantiles of each quantity over the events of a decade, and the number of events in which it is known.
void add_quantities(const std::vector<Decade>& population, int decade, int quantile, std::vector<Variable>& all) {
  std::size_t i = 0;
  for (const Description& about : results::population_quantities()) {
    const std::string name = "population_" + std::string(about.name);
    std::vector<double> values;
    for (const Decade& d : population) {
      const catalogue::Quantiles& q = d.spread[i].of;
      values.insert(values.end(), {q.low, q.median, q.high});
    }
    all.push_back({described(name, "quantiles over the events of a decade: " + std::string(about.long_name),
                             about.dimensional_unit, about.reference, results::unit_of(about)),
                   {decade, quantile},
                   values});
    all.push_back({described(name + "_events",
                             "number of events in which this is known: " + std::string(about.long_name), "", ""),
                   {decade},
                   each(population, [&](const Decade& d) { return d.spread[i].events; })});
    ++i;
  }
}

}  // namespace

std::vector<Variable> population_variables(netcdf::Writer& file, const std::vector<Decade>& population, int quantile) {
  constexpr std::string_view closed_form = "Eqs. 8-10";
  const auto line = catalogue::line_through(population);
  const int decade = file.dimension("decade", population.size()), ends = file.dimension("ends", 2),
            point = file.dimension("line_point", line.size());
  std::vector<Variable> all;
  all.push_back({described("decade", "rupture velocity in the middle of a decade", "c", closed_form),
                 {decade},
                 each(population, [](const Decade& d) { return d.middle; })});
  std::vector<double> bounds;
  for (const Decade& d : population) bounds.insert(bounds.end(), {d.low, d.high});
  all.push_back({described("decade_bounds", "ends of a decade; the upper end is excluded", "c", closed_form),
                 {decade, ends},
                 bounds});
  all.push_back({described("population_events", "number of events with a rupture velocity in this decade", "", ""),
                 {decade},
                 each(population, [](const Decade& d) { return d.events; })});
  all.push_back({described("population_closed_form_stress", "stress of the closed form in the middle of the decade",
                           "mu A / pi", closed_form),
                 {decade},
                 each(population, [](const Decade& d) { return d.stress; })});
  all.push_back({described("population_closed_form_slip_velocity",
                           "W(0) of the closed form in the middle of the decade", "c A / pi", closed_form),
                 {decade},
                 each(population, [](const Decade& d) { return d.slip_velocity; })});
  add_quantities(population, decade, quantile, all);
  using catalogue::LinePoint;
  all.push_back({described("line_rupture_velocity", "closed form: rupture velocity", "c", closed_form),
                 {point},
                 each(line, [](const LinePoint& p) { return p.rupture_velocity; })});
  all.push_back({described("line_stress", "closed form: stress", "mu A / pi", closed_form),
                 {point},
                 each(line, [](const LinePoint& p) { return p.stress; })});
  all.push_back({described("line_slip_velocity", "closed form: slip velocity W(0)", "c A / pi", closed_form),
                 {point},
                 each(line, [](const LinePoint& p) { return p.slip_velocity; })});
  return all;
}

}  // namespace slipfront::record::event_layout
