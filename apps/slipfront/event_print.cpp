#include "event_print.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "batch.hpp"
#include "event_output.hpp"
#include "events/results/columns.hpp"
#include "population_output.hpp"
#include "runs/record/events/event_file.hpp"

namespace {

using namespace slipfront::results;
using slipfront::record::event_csv_head;
using slipfront::record::event_csv_row;
using slipfront::run::CatalogueColumns;

constexpr std::size_t most_errors_shown = 20;

std::string not_understood(const std::vector<std::string>& titles) {
  return fmt::format("columns that look like quantities and are not understood: {} (--columns MAP.toml can name them)",
                     fmt::join(titles, ", "));
}

std::string events(std::size_t count) { return fmt::format("{} event{}", count, count == 1 ? "" : "s"); }

}  // namespace

EventPrinter::EventPrinter(const CommonOptions& options, const EventShown& shown)
    : options_(options), shown_(shown), table_(event_table_head()) {
  if (options_.json) put("{\"events\": [");
  if (options_.csv && has_rows()) put(event_csv_head(shown_.pulse));
}

EventPrinter::Printed EventPrinter::printed(const EventResult& result, std::size_t count) const {
  Printed p{{}, {}, {}, result.error, result.warnings(), {}, result.posterior && result.posterior->suffices};
  if (shown_.population) p.member = member_of(result);
  if (!has_rows()) return p;
  if (is_table()) {
    p.table = event_table_row(result);
    add_event_pulse(*p.table, result);
    if (count_ + count == 1) p.report = event_report(result);
  } else {
    p.row = options_.json ? event_json(result) : event_csv_row(result, shown_.pulse);
  }
  return p;
}

void EventPrinter::take(Printed&& p) {
  if (options_.json) put(count_ == 0 ? "\n" : ",\n");
  if (p.table) {
    table_.append(std::move(*p.table));
    report_ = std::move(p.report);
  } else {
    put(p.row);
  }
  ++count_;
  sampled_ = sampled_ || p.sampled;
  if (p.member) population_.add(*p.member);
  for (const std::string& warning : p.warnings) ++warnings_[warning];
  if (!p.error.empty() && ++errors_ <= most_errors_shown) complain(p.error);
}

void EventPrinter::finish(const CatalogueColumns& columns, const std::string& written) {
  if (options_.json) {
    put("\n]");
    put(", " + columns_json(columns));
    if (shown_.population) put(", \"population\": " + population_json(population_.decades()));
    put("}\n");
  } else if (options_.csv) {
    if (shown_.population) put(population_csv(population_.decades()));
  } else if (count_ > errors_) {  // a table of nothing but errors would only repeat stderr
    print_table(columns, written);
  }
  std::fflush(stdout);
  if (!options_.quiet) complain_of_columns(columns);
  if (errors_ > most_errors_shown)
    complain(fmt::format("... and {} more events with errors", errors_ - most_errors_shown));
}

void EventPrinter::complain_of_columns(const CatalogueColumns& columns) const {
  for (const auto& [file, table] : columns.files) {
    if (!table.ignored_quantities.empty())
      complain(fmt::format("warning: {}: {}", file, not_understood(table.ignored_quantities)));
    for (const std::string& note : table.notes) complain("note: " + note);
  }
  std::string others;
  for (const std::string& title : columns.ignored)
    if (std::find(columns.ignored_quantities.begin(), columns.ignored_quantities.end(), title) ==
        columns.ignored_quantities.end())
      others += (others.empty() ? "" : ", ") + title;
  if (!others.empty() && !options_.json) complain("note: columns without an observation, ignored: " + others);
}

void EventPrinter::print_table(const CatalogueColumns& columns, const std::string& written) const {
  const bool is_report = count_ == 1 && !options_.wide;
  if (has_rows()) put(is_report ? report_ : table_.text());
  if (has_rows() && !options_.quiet && sampled_ && !is_report)
    put("\n" + fitted("The columns after the observed velocities are inferred. Where a row has 5 % and 95 % below it, "
                      "they are medians of the posterior, which need not equal the observed values."));
  if (shown_.population) put(population_table(population_.decades(), count_, errors_));
  if (options_.quiet) return;
  print_notes(columns);
  if (written.empty()) return;
  put((shown_.population || !warnings_.empty() ? "\n" : "") +
      fitted(fmt::format("{}{} written to {}", events(count_),
                         errors_ > 0 ? fmt::format(", {} of them with errors,", errors_) : "", written)));
}

/// Warnings, most frequent first, each once.
void EventPrinter::print_notes(const CatalogueColumns& columns) const {
  std::vector<std::pair<std::size_t, std::string>> notes;
  for (const auto& [text, count] : warnings_) notes.emplace_back(count, text);
  // Sources that disagree come first: each speaks of a few events, and must not be among those left out.
  const auto rank = [](const auto& note) {
    return std::pair(note.second.starts_with("sources of ") ? 1 : 0, note.first);
  };
  std::stable_sort(notes.begin(), notes.end(), [&](const auto& a, const auto& b) { return rank(a) > rank(b); });
  if (notes.empty() && columns.ignored_quantities.empty()) return;
  if (has_rows() || shown_.population) put("\n");
  put(fitted("Notes (--json gives those of each event; --quiet none):"));
  for (const auto& [file, table] : columns.files)
    if (!table.ignored_quantities.empty())
      put(fitted(fmt::format("  {}: {}", file, not_understood(table.ignored_quantities)), 4));
  constexpr std::size_t most = 15;
  for (std::size_t i = 0; i < std::min(notes.size(), most); ++i)
    put(fitted("  " + notes[i].second + (count_ == 1 ? "" : fmt::format(" ({})", events(notes[i].first))), 4));
  if (notes.size() > most) put(fmt::format("  ... and {} more\n", notes.size() - most));
}
