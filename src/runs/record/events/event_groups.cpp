#include "runs/record/events/event_groups.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <optional>
#include <string_view>

#include "events/results/columns.hpp"
#include "math/constants.hpp"
#include "math/digits.hpp"
#include "runs/record/arrays.hpp"
#include "runs/record/events/event_file.hpp"
#include "system/files/whole_file.hpp"

namespace slipfront::record::event_layout {
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
