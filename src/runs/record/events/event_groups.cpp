#include "runs/record/events/event_groups.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <optional>
#include <string_view>

#include "events/results/columns.hpp"
#include "math/digits.hpp"
#include "runs/record/arrays.hpp"
#include "runs/record/events/event_file.hpp"
#include "system/files/whole_file.hpp"

namespace slipfront::record {

using inference::FaultState;
using inference::observed_quantities;
using inference::ObservedQuantity;
using inference::Posterior;
using netcdf::Writer;
using results::EventResult;
using results::NumberColumn;

namespace {

constexpr std::string_view resampled =
    "Samples of importance sampling at points of a Sobol sequence, resampled systematically to states of equal weight. "
    "One sample can occur more than once. There is one chain.";

NumberColumn described(std::string_view name, std::string_view long_name, std::string_view unit) {
  return {std::string(name), std::string(long_name), unit, "", "", results::Axis::none, 1, {}};
}

int define(Writer& file, const NumberColumn& about, const std::vector<int>& dimensions) {
  const int id = file.reals(about.name, dimensions);
  file.attribute(id, "long_name", about.long_name);
  file.attribute(id, "units", about.unit);
  if (!about.reference.empty()) {
    file.attribute(id, "dimensional_unit", about.dimensional_unit);
    file.attribute(id, "references", reference_of({{}, {}, {}, about.reference}));
  }
  file.fill_value(id, none);
  return id;
}

}  // namespace

EventGroups::EventGroups(const Writer& file, const std::string& version, std::span<const EventResult> results,
                         std::size_t draws)
    : version_(version), results_(results), draws_(draws) {
  add_states(add_group(file, "posterior", resampled, true), &Posterior::draws);
  add_states(add_group(file, "prior", "States drawn from the prior, at points of a Sobol sequence.", true),
             &Posterior::prior_draws);
  add_repeated(add_group(
      file, "posterior_predictive",
      "A repeated observation of each state of the group posterior, with the error of the observation.", true));
  add_observed(add_group(file, "observed_data", "The middles of the observed numbers.", false));
  add_statistics(add_group(file, "sample_stats", "Diagnostics of the importance sampling of each event.", false));
}

EventGroups::Group& EventGroups::add_group(const Writer& file, const std::string& name, std::string_view about,
                                           bool has_draws) {
  Group& g = groups_.emplace_back(file, name);
  g.file.attribute(Writer::global, "slipfront_format", std::string_view(event_format));
  g.file.attribute(Writer::global, "inference_library", std::string_view("slipfront"));
  g.file.attribute(Writer::global, "inference_library_version", std::string_view(version_));
  g.file.attribute(Writer::global, "comment", about);
  g.file.attribute(Writer::global, "coordinates", std::string_view("event_name"));
  const auto axis = [&](const char* title, std::size_t size) {
    const int dimension = g.file.dimension(title, size);
    std::vector<std::int64_t> positions(size);
    std::iota(positions.begin(), positions.end(), 0);
    g.positions.emplace_back(g.file.integers(title, {dimension}), std::move(positions));
    return dimension;
  };
  if (has_draws) g.chain = axis("chain", 1), g.draw = axis("draw", draws_);
  g.event = axis("event", results_.size());
  g.names = g.file.strings("event_name", {g.event});
  g.file.attribute(g.names, "long_name", std::string_view("name of the event"));
  return g;
}

void EventGroups::add_draws(Group& group, const NumberColumn& about,
                            const std::function<double(const Result&, std::size_t)>& get) {
  // The first draw decides, because the draws of an event have the same quantities.
  if (std::all_of(results_.begin(), results_.end(), [&](const Result& r) { return std::isnan(get(r, 0)); })) return;
  const auto values = [this, get] {
    std::vector<double> all;
    all.reserve(draws_ * results_.size());
    for (std::size_t i = 0; i < draws_; ++i)
      for (const Result& r : results_) all.push_back(get(r, i));
    return all;
  };
  group.numbers.emplace_back(define(group.file, about, {group.chain, group.draw, group.event}), values);
}

void EventGroups::add_events(Group& group, const NumberColumn& about, const std::function<double(const Result&)>& get) {
  if (std::all_of(results_.begin(), results_.end(), [&](const Result& r) { return std::isnan(get(r)); })) return;
  const auto values = [this, get] {
    std::vector<double> all;
    for (const Result& r : results_) all.push_back(get(r));
    return all;
  };
  group.numbers.emplace_back(define(group.file, about, {group.event}), values);
}

void EventGroups::add_states(Group& group, std::vector<FaultState> Posterior::*states) {
  for (const inference::Quantity& q : inference::quantities()) {
    NumberColumn about = described(q.about.name, q.about.long_name, results::unit_of(q.about));
    about.dimensional_unit = q.about.dimensional_unit;
    about.reference = q.about.reference;
    add_draws(group, about, [states, value = q.state](const Result& r, std::size_t i) {
      return r.posterior && i < ((*r.posterior).*states).size() ? ((*r.posterior).*states)[i].*value : none;
    });
  }
}

void EventGroups::add_repeated(Group& group) {
  for (const ObservedQuantity& q : observed_quantities())
    add_draws(group, described(q.name, "repeated observation of: " + std::string(q.long_name), q.unit),
              [position = inference::position_of(q.name)](const Result& r, std::size_t i) {
                return r.posterior && i < r.posterior->repeated.size() ? r.posterior->repeated[i][position] : none;
              });
}

void EventGroups::add_observed(Group& group) {
  for (const ObservedQuantity& q : observed_quantities())
    add_events(group, described(q.name, "observed " + std::string(q.long_name), q.unit),
               [position = inference::position_of(q.name)](const Result& r) {
                 return inference::observed_values(r.observation)[position];
               });
}

void EventGroups::add_statistics(Group& group) {
  const auto add = [&](std::string_view name, std::string_view long_name, double (*get)(const Posterior&)) {
    add_events(group, described(name, long_name, "1"),
               [get](const Result& r) { return r.posterior ? get(*r.posterior) : none; });
  };
  add("effective_samples", "effective number of samples before resampling",
      [](const Posterior& p) { return p.effective_samples; });
  add("pareto_k", "shape of the tail of the weights: above 0.7 no draws",
      [](const Posterior& p) { return p.pareto_k; });
  add("samples", "samples before resampling", [](const Posterior& p) { return static_cast<double>(p.samples); });
}

void EventGroups::write() {
  for (Group& g : groups_) {
    for (const auto& [id, positions] : g.positions)
      if (!positions.empty()) g.file.write_all(id, positions);
    for (const auto& [id, values] : g.numbers) g.file.write_all(id, values());
    std::vector<std::string> names;
    for (const Result& r : results_) names.push_back(clean_text(r.observation.name, netcdf::longest_text));
    if (!names.empty()) g.file.write_all(g.names, names);
  }
}

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
