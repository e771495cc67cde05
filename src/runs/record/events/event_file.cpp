#include "runs/record/events/event_file.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numeric>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

#include "events/results/columns.hpp"
#include "events/results/evaluate.hpp"
#include "math/constants.hpp"
#include "math/digits.hpp"
#include "runs/record/arrays.hpp"
#include "runs/record/netcdf/netcdf.hpp"
#include "slipfront/error.hpp"
#include "system/files/whole_file.hpp"

namespace slipfront::record {
namespace {

using catalogue::Decade;
using results::EventResult;

using Results = std::span<const EventResult>;

using event_layout::number;
using event_layout::text;

void add_axes(Dataset& file, std::size_t events, std::size_t draws) {
  file.dimensions = {{"event", events}, {"bound", 2}, {"quantile", 3}};
  if (draws > 0) file.dimensions.emplace_back("draw", draws);
  file.variables = {text("bound", "ends of an interval", "bound", {"5 %", "95 %"}),
                    number({"quantile", "share of the values below", "1", "", "", results::Axis::none, 1, {}},
                           {"quantile"}, std::vector{0.05, 0.5, 0.95})};
}

void add_events(Dataset& file, Results results, const results::ColumnChoice& choice) {
  for (const results::NumberColumn& column : results::number_columns(choice)) {
    std::vector<double> values(results.size() * column.count);
    for (std::size_t i = 0; i < results.size(); ++i) column.get(results[i], &values[i * column.count]);
    std::vector<std::string> dimensions = {"event"};
    if (column.axis == results::Axis::bound) dimensions.emplace_back("bound");
    if (column.axis == results::Axis::quantile) dimensions.emplace_back("quantile");
    if (column.axis == results::Axis::draw) dimensions.emplace_back("draw");
    file.variables.push_back(number(column, dimensions, std::move(values)));
  }
  for (const results::TextColumn& column : results::text_columns(choice.pulse)) {
    std::vector<std::string> values;
    for (const EventResult& r : results) values.push_back(column.get(r));
    file.variables.push_back(text(column.name, column.long_name, "event", values));
  }
}

std::string in_one_line(const std::vector<std::string>& titles) {
  std::string all;
  for (const std::string& title : titles) all += (all.empty() ? "" : ", ") + title;
  return all;
}

Attributes attributes_of(const EventMetadata& metadata, bool finished) {
  Attributes all;
  const auto say = [&](const std::string& name, std::string_view text) {
    all.emplace_back(name, clean_text(text, netcdf::longest_text));
  };
  for (const auto& [name, text] : file_attributes({.format = event_format,
                                  .title = "Observed events",
                                  .scenario_text = {},
                                  .version = metadata.version,
                                  .command_line = metadata.command_line}))
    if (name != "scenario" && name != "comment") say(name, text);
  say("comment",
      "Variables in units of 1 are dimensionless. Multiply them by dimensional_unit, where A is the contact ratio, c "
      "the speed of strain waves and mu the shear modulus. Values that are not known are NaN.");
  for (const auto& [name, text] : metadata.settings) say(name, text);
  say("ignored_columns", in_one_line(metadata.ignored_columns));
  say("ignored_quantities", in_one_line(metadata.ignored_quantities));
  all.emplace_back("finished", finished ? 1 : 0);
  return all;
}

}  // namespace

void write_events(const std::string& path, const EventMetadata& metadata, Results results,
                  const std::vector<Decade>& population, bool finished) {
  Dataset file{.attributes = attributes_of(metadata, finished)};
  add_axes(file, results.size(), metadata.columns.draws);
  add_events(file, results, metadata.columns);
  event_layout::add_population(file, population);
  file.add_opaque(event_layout::state, "results of the finished events, from which a run resumes",
                  results::serialize(results));
  if (metadata.columns.draws > 0)
    file.groups = event_layout::groups_of(results, metadata.version, metadata.columns.draws);
  write_dataset(path, file);
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
void add_quantities(Dataset& file, const std::vector<Decade>& population) {
  std::size_t i = 0;
  for (const Description& about : results::population_quantities()) {
    const std::string name = "population_" + std::string(about.name);
    std::vector<double> values;
    for (const Decade& d : population) {
      const catalogue::Quantiles& q = d.spread[i].of;
      values.insert(values.end(), {q.low, q.median, q.high});
    }
    file.variables.push_back(
        number(described(name, "quantiles over the events of a decade: " + std::string(about.long_name),
                         about.dimensional_unit, about.reference, results::unit_of(about)),
               {"decade", "quantile"}, values));
    file.variables.push_back(number(
        described(name + "_events", "number of events in which this is known: " + std::string(about.long_name), "", ""),
        {"decade"}, each(population, [&](const Decade& d) { return d.spread[i].events; })));
    ++i;
  }
}

}  // namespace

DatasetVariable number(const NumberColumn& about, const std::vector<std::string>& dimensions,
                       decltype(DatasetVariable::values) values) {
  DatasetVariable variable{about.name, dimensions, std::move(values)};
  variable.attributes = {{"long_name", about.long_name}, {"units", std::string(about.unit)}};
  if (!about.reference.empty()) {
    variable.attributes.emplace_back("dimensional_unit", std::string(about.dimensional_unit));
    variable.attributes.emplace_back("references", reference_of({{}, {}, {}, about.reference}));
  }
  variable.attributes.emplace_back("_FillValue", none);
  return variable;
}

DatasetVariable text(std::string_view name, std::string_view long_name, const std::string& dimension,
                     const std::vector<std::string>& values) {
  std::vector<std::string> clean;
  clean.reserve(values.size());
  for (const std::string& value : values) clean.push_back(clean_text(value, netcdf::longest_text));
  return {std::string(name), {dimension}, std::move(clean), {{"long_name", std::string(long_name)}}};
}

void add_population(Dataset& file, const std::vector<Decade>& population) {
  constexpr std::string_view closed_form = "Eqs. 8-10";
  const auto line = catalogue::line_through(population);
  file.dimensions.emplace_back("decade", population.size());
  file.dimensions.emplace_back("ends", 2);
  file.dimensions.emplace_back("line_point", line.size());
  std::vector<double> bounds;
  for (const Decade& d : population) bounds.insert(bounds.end(), {d.low, d.high});
  const auto add = [&](const NumberColumn& about, const auto& get) {
    file.variables.push_back(number(about, {"decade"}, each(population, get)));
  };
  add(described("decade", "rupture velocity in the middle of a decade", "c", closed_form),
      [](const Decade& d) { return d.middle; });
  file.variables.back().attributes.emplace_back("bounds", "decade_bounds");
  file.variables.push_back(
      number(described("decade_bounds", "ends of a decade; the upper end is excluded", "c", closed_form),
             {"decade", "ends"}, bounds));
  add(described("population_events", "number of events with a rupture velocity in this decade", "", ""),
      [](const Decade& d) { return d.events; });
  add(described("population_closed_form_stress", "stress of the closed form in the middle of the decade", "mu A / pi",
                closed_form),
      [](const Decade& d) { return d.stress; });
  add(described("population_closed_form_slip_velocity", "W(0) of the closed form in the middle of the decade",
                "c A / pi", closed_form),
      [](const Decade& d) { return d.slip_velocity; });
  add_quantities(file, population);
  using catalogue::LinePoint;
  const auto add_line = [&](const NumberColumn& about, double LinePoint::*value) {
    file.variables.push_back(number(about, {"line_point"}, each(line, [&](const LinePoint& p) { return p.*value; })));
  };
  add_line(described("line_rupture_velocity", "closed form: rupture velocity", "c", closed_form),
           &LinePoint::rupture_velocity);
  add_line(described("line_stress", "closed form: stress", "mu A / pi", closed_form), &LinePoint::stress);
  add_line(described("line_slip_velocity", "closed form: slip velocity W(0)", "c A / pi", closed_form),
           &LinePoint::slip_velocity);
}

namespace {

using inference::FaultState;
using inference::observed_quantities;
using inference::ObservedQuantity;
using inference::Posterior;
using results::EventResult;
using results::NumberColumn;

constexpr std::string_view resampled =
    "Samples of importance sampling at points of a Sobol sequence, resampled systematically to states of equal weight. "
    "One sample can occur more than once. There is one chain.";

NumberColumn described(std::string_view name, std::string_view long_name, std::string_view unit) {
  return {std::string(name), std::string(long_name), unit, "", "", results::Axis::none, 1, {}};
}

/// The groups of one file.
class Groups {
 public:
  Groups(std::span<const EventResult> results, const std::string& version, std::size_t draws)
      : results_(results), version_(version), draws_(draws) {}

  Dataset states(const std::string& name, std::string_view about, std::vector<FaultState> Posterior::*states) const {
    Dataset group = begun(name, about, true);
    for (const inference::Quantity& q : inference::quantities()) {
      NumberColumn column = described(q.about.name, q.about.long_name, results::unit_of(q.about));
      column.dimensional_unit = q.about.dimensional_unit;
      column.reference = q.about.reference;
      add_draws(group, column, [states, value = q.state](const EventResult& r, std::size_t i) {
        return r.posterior && i < ((*r.posterior).*states).size() ? ((*r.posterior).*states)[i].*value : none;
      });
    }
    return group;
  }

  Dataset repeated() const {
    Dataset group = begun("posterior_predictive",
                          "A repeated observation of each state of the group posterior, with the error of the "
                          "observation.",
                          true);
    for (const ObservedQuantity& q : observed_quantities())
      add_draws(group, described(q.name, "repeated observation of: " + std::string(q.long_name), q.unit),
                [position = inference::position_of(q.name)](const EventResult& r, std::size_t i) {
                  return r.posterior && i < r.posterior->repeated.size() ? r.posterior->repeated[i][position] : none;
                });
    return group;
  }

  Dataset observed() const {
    Dataset group = begun("observed_data", "The middles of the observed numbers.", false);
    for (const ObservedQuantity& q : observed_quantities())
      add_events(group, described(q.name, "observed " + std::string(q.long_name), q.unit),
                 [position = inference::position_of(q.name)](const EventResult& r) {
                   return inference::observed_values(r.observation)[position];
                 });
    return group;
  }

  Dataset statistics() const {
    Dataset group = begun("sample_stats", "Diagnostics of the importance sampling of each event.", false);
    const auto add = [&](std::string_view name, std::string_view long_name, double (*get)(const Posterior&)) {
      add_events(group, described(name, long_name, "1"),
                 [get](const EventResult& r) { return r.posterior ? get(*r.posterior) : none; });
    };
    add("effective_samples", "effective number of samples before resampling",
        [](const Posterior& p) { return p.effective_samples; });
    add("pareto_k", "shape of the tail of the weights: above 0.7 no draws",
        [](const Posterior& p) { return p.pareto_k; });
    add("samples", "samples before resampling", [](const Posterior& p) { return static_cast<double>(p.samples); });
    return group;
  }

 private:
  Dataset begun(const std::string& name, std::string_view about, bool has_draws) const {
    Dataset group{.name = name};
    group.attributes = {{"slipfront_format", event_format},
                        {"inference_library", "slipfront"},
                        {"inference_library_version", version_},
                        {"comment", std::string(about)},
                        {"coordinates", "event_name"}};
    const auto add_axis = [&](const char* title, std::size_t size) {
      std::vector<std::int64_t> positions(size);
      std::iota(positions.begin(), positions.end(), 0);
      group.dimensions.emplace_back(title, size);
      group.variables.push_back({title, {title}, std::move(positions)});
    };
    if (has_draws) add_axis("chain", 1), add_axis("draw", draws_);
    add_axis("event", results_.size());
    std::vector<std::string> names;
    for (const EventResult& r : results_) names.push_back(r.observation.name);
    group.variables.push_back(text("event_name", "name of the event", "event", names));
    return group;
  }

  /// Adds a variable over chain, draw and event, unless it has no values.
  template <class Get>
  void add_draws(Dataset& group, const NumberColumn& about, const Get& get) const {
    // The first draw decides, because the draws of an event have the same quantities.
    const auto is_unknown = [&](const EventResult& r) { return std::isnan(get(r, 0)); };
    if (std::all_of(results_.begin(), results_.end(), is_unknown)) return;
    const auto values = [results = results_, draws = draws_, get] {
      std::vector<double> all;
      all.reserve(draws * results.size());
      for (std::size_t i = 0; i < draws; ++i)
        for (const EventResult& r : results) all.push_back(get(r, i));
      return all;
    };
    group.variables.push_back(number(about, {"chain", "draw", "event"}, values));
  }

  /// Adds a variable over event, unless it has no values.
  template <class Get>
  void add_events(Dataset& group, const NumberColumn& about, const Get& get) const {
    std::vector<double> values;
    for (const EventResult& r : results_) values.push_back(get(r));
    if (std::all_of(values.begin(), values.end(), [](double value) { return std::isnan(value); })) return;
    group.variables.push_back(number(about, {"event"}, std::move(values)));
  }

  std::span<const EventResult> results_;
  const std::string& version_;
  std::size_t draws_;
};

}  // namespace

std::vector<Dataset> groups_of(std::span<const EventResult> results, const std::string& version, std::size_t draws) {
  const Groups groups(results, version, draws);
  return {
      groups.states("posterior", resampled, &Posterior::draws),
      groups.states("prior", "States drawn from the prior, at points of a Sobol sequence.", &Posterior::prior_draws),
      groups.repeated(), groups.observed(), groups.statistics()};
}

}  // namespace slipfront::record::event_layout

namespace slipfront::record {
namespace {

using finite_fault::pulse_quantities;
using inference::answer_quantities;
using inference::bound_quantities;
using inference::Posterior;
using inference::posterior_quantities;
using results::answer_of;
using results::event_numbers;
using results::EventResult;
using results::joined;

/// A CSV cell with text. A spreadsheet would run text that begins like a formula, so we put an apostrophe before it
/// (docs/events.md).
std::string quoted(const std::string& text) {
  const bool like_formula = !text.empty() && std::string_view("=+-@\t").find(text[0]) != std::string_view::npos;
  std::string out = like_formula ? "\"'" : "\"";
  for (const char c : text) out += c == '"' ? std::string("\"\"") : std::string(1, c == '\n' || c == '\r' ? ' ' : c);
  return out + "\"";
}

std::string cell(const std::optional<double>& number) { return number ? "," + shortest(*number) : ","; }

/// The cells of a quantity and of the ends of its interval.
std::string cells(const std::optional<inference::Inferred>& x) {
  if (!x) return ",,,";
  return cell(x->value) + (x->interval ? cell(x->interval->low) + cell(x->interval->high) : ",,");
}

/// The titles of a quantity and of the ends of its interval.
std::string titles(std::string_view name) {
  const std::string title = "," + std::string(name);
  return title + title + "_low" + title + "_high";
}

}  // namespace

std::string event_csv_head(bool with_pulse) {
  std::string head = "name,date,kind";
  for (const auto& number : event_numbers()) head += "," + std::string(number.about.name);
  for (const auto& q : answer_quantities()) head += titles(q.about.name);
  for (const auto& q : posterior_quantities()) head += titles("posterior_" + std::string(q.about.name));
  head += ",friction_identified,effective_samples,seed,warnings,error,citation,note,file,line";
  if (with_pulse) {
    for (const auto& q : pulse_quantities()) head += "," + std::string(q.about.name);
    head += ",pulse_reason";
  }
  for (const auto& q : bound_quantities()) head += titles(q.about.name);
  return head + ",pareto_k,samples\n";
}

std::string event_csv_row(const EventResult& result, bool with_pulse) {
  const auto& o = result.observation;
  const auto& posterior = result.posterior;
  std::string row = quoted(o.name) + "," + quoted(o.date) + "," + quoted(o.kind);
  for (const auto& number : event_numbers()) row += cell(number.get(result));
  for (const auto& q : answer_quantities()) row += cells(answer_of(result, q));
  const Posterior none;
  for (const auto& quantity : posterior_quantities()) {
    const auto& q = (posterior ? *posterior : none).*quantity.quantiles;
    row += q ? cell(q->median) + cell(q->low) + cell(q->high) : ",,,";
  }
  row += posterior ? (posterior->friction_identified ? ",yes" : ",no") + cell(posterior->effective_samples) + "," +
                         std::to_string(posterior->seed)
                   : ",,,";
  for (const std::string& text : {joined(result.warnings()), result.error, o.citation, o.note, o.file})
    row += "," + quoted(text);
  row += "," + std::to_string(o.line);
  if (with_pulse) {
    const bool ran = result.pulse && result.pulse->reason.empty();
    for (const auto& q : pulse_quantities()) row += cell(ran ? q.get(*result.pulse) : std::nullopt);
    row += "," + quoted(result.pulse ? result.pulse->reason : "");
  }
  for (const auto& q : bound_quantities()) row += cells(answer_of(result, q));
  row += posterior ? cell(posterior->pareto_k) + "," + std::to_string(posterior->samples) : ",,";
  return row + "\n";
}

void write_events_csv(const std::string& path, std::span<const EventResult> results, bool with_pulse) {
  std::string text = event_csv_head(with_pulse);
  for (const EventResult& result : results) text += event_csv_row(result, with_pulse);
  write_text(path, text);
}

}  // namespace slipfront::record
