#include "record/events/event_csv.hpp"

#include <optional>
#include <string_view>

#include "foundation/text/digits.hpp"
#include "record/files/text_file.hpp"
#include "results/columns.hpp"
#include "results/quantities.hpp"

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
