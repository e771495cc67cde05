#include "runs/catalogue.hpp"

#include <algorithm>
#include <filesystem>
#include <optional>
#include <span>
#include <utility>

#include "events/catalogue/population.hpp"
#include "events/finite_fault/on_plane.hpp"
#include "events/results/columns.hpp"
#include "events/results/evaluate.hpp"
#include "slipfront/error.hpp"
#include "slipfront/events/catalogue/read.hpp"
#include "system/machine.hpp"
#include "system/parallel.hpp"

namespace slipfront::run {
namespace {

using catalogue::Entry;
using results::EvaluationOptions;
using results::EventResult;

void add_once(std::vector<std::string>& all, const std::vector<std::string>& more) {
  for (const std::string& title : more)
    if (std::find(all.begin(), all.end(), title) == all.end()) all.push_back(title);
}

/// Why --strict refuses a text: its first bad row, or a column that looks like a quantity. Nothing if it does not.
std::optional<Complaint> why_refused(const std::string& file, std::span<const Entry> entries,
                                     const catalogue::TableNotes& notes, const medium::Defaults& defaults) {
  EvaluationOptions closed_forms;
  closed_forms.sampling.samples = 0;
  for (const Entry& entry : entries) {
    std::optional<Complaint> error = entry.error;
    if (!error)
      if (const std::string text = evaluate(Entry(entry), defaults, closed_forms).error; !text.empty())
        error = Complaint{.problem = text};
    if (!error) continue;
    error->problem += " (--strict refuses the file)";
    return error;
  }
  if (notes.ignored_quantities.empty()) return std::nullopt;
  return Complaint{.file = file,
                   .key = notes.ignored_quantities.front(),
                   .problem = "a column that looks like a quantity and is not understood (--strict refuses the file)",
                   .allowed = "columns that --columns map.toml names, or \"ignore\" there"};
}

/// An entry that has only an error.
Entry bad_entry(const std::string& file, Complaint&& error) {
  Entry entry;
  entry.observation.name = file;
  entry.observation.file = file;
  entry.error = std::move(error);
  return entry;
}

struct Entries {
  std::vector<Entry> all;  ///< with warnings if sources of one earthquake disagree
  CatalogueColumns columns;
};

/// Reads the entries of a text. One that could not be read gives one entry, with the reason.
void read_entries(const EventText& t, const CatalogueScenario& scenario, const medium::Defaults& defaults,
                  Entries& read) {
  if (!t.error.empty()) {
    read.columns.unreadable = read.columns.unreadable || t.folder.empty();
    read.all.push_back(bad_entry(t.name, Complaint{.problem = t.error}));
    return;
  }
  const std::size_t first = read.all.size();
  catalogue::TableNotes notes = catalogue::read_events(
      t.text, t.name, [&](Entry&& entry) { read.all.push_back(std::move(entry)); }, scenario.table);
  const auto entries = std::span<const Entry>(read.all).subspan(first);
  if (auto refused = scenario.strict ? why_refused(t.name, entries, notes, defaults) : std::nullopt) {
    read.all.resize(first);
    read.all.push_back(bad_entry(t.name, std::move(*refused)));
    return;
  }
  add_once(read.columns.ignored, notes.ignored);
  add_once(read.columns.ignored_quantities, notes.ignored_quantities);
  if (!notes.ignored.empty() || !notes.notes.empty()) read.columns.files.push_back({t.name, std::move(notes)});
}

std::string file_name(const std::string& path) { return std::filesystem::path(path).filename().string(); }

/// Makes the entries from `first` on, which come from one folder, sources of one event, with the name and the date of
/// the first that has a date. Removes those with errors and names their files in one warning, unless all have errors.
void unite(Entries& read, std::size_t first, const std::string& folder) {
  const auto begin = read.all.begin() + static_cast<std::ptrdiff_t>(first);
  const auto end = std::stable_partition(begin, read.all.end(), [](const Entry& entry) { return !entry.error; });
  if (end == begin) return;
  std::string not_read;
  for (auto bad = end; bad != read.all.end(); ++bad)
    not_read += (not_read.empty() ? "; not read: " : ", ") + file_name(bad->observation.file);
  read.all.erase(end, read.all.end());
  const auto named =
      std::find_if(begin, read.all.end(), [](const Entry& entry) { return !entry.observation.date.empty(); });
  const catalogue::Observation event = (named == read.all.end() ? begin : named)->observation;
  const std::string note =
      "sources of one event in " + folder + ": " + std::to_string(read.all.size() - first) + not_read;
  for (auto source = begin; source != read.all.end(); ++source) {
    catalogue::Observation& o = source->observation;
    source->event = folder;
    o.name = file_name(o.file) + ": " + event.name;
    if (o.date.empty()) o.date = event.date;
    o.warnings.push_back(note);
  }
}

/// Reads the entries of all texts.
Entries read_all(const CatalogueScenario& scenario, const medium::Defaults& defaults) {
  Entries read;
  std::size_t first = 0;  // entry of a folder
  for (std::size_t i = 0; i < scenario.texts.size(); ++i) {
    const std::string& folder = scenario.texts[i].folder;
    if (i == 0 || folder != scenario.texts[i - 1].folder) first = read.all.size();
    read_entries(scenario.texts[i], scenario, defaults, read);
    const bool is_last = i + 1 == scenario.texts.size() || folder != scenario.texts[i + 1].folder;
    if (!folder.empty() && is_last && !scenario.strict) unite(read, first, folder);
  }
  finite_fault::warn_of_other_sources(read.all, defaults);
  return read;
}

/// The settings on which the results depend. The number of threads is not one of them.
std::vector<std::pair<std::string, std::string>> settings_of(const CatalogueScenario& scenario) {
  const EvaluationOptions& e = scenario.evaluation;
  const auto stated = [](const std::string& text) { return text.empty() ? "default" : text; };
  std::string inputs;
  if (!scenario.table.map.empty())
    inputs = record::checksum_of_inputs(inputs, scenario.table.map_file, scenario.table.map);
  for (const EventText& t : scenario.texts)
    inputs = record::checksum_of_inputs(inputs, t.name, t.error.empty() ? t.text : t.error);
  return {{"seed", std::to_string(e.sampling.seed)},
          {"samples", std::to_string(e.sampling.samples)},
          {"sampled_events", e.sample_all ? "all" : "those with errors or observations of friction"},
          {"closure", name_of(e.sampling.closure)},
          {"pulse", e.pulse ? "yes" : "no"},
          {"posterior_draws", std::to_string(e.sampling.draws)},
          {"p_wave_speed", stated(scenario.medium.p_wave_speed)},
          {"poisson_ratio", stated(scenario.medium.poisson_ratio)},
          {"shear_modulus", stated(scenario.medium.shear_modulus)},
          {"input_checksum", inputs}};
}

/// Evaluates a catalogue, and writes its file.
class Evaluation {
 public:
  Evaluation(CataloguePlan&& plan, const CatalogueOptions& options)
      : plan_(std::move(plan)), options_(options), results_(plan_.entries.size()), is_done_(plan_.entries.size()) {}

  void resume() {
    auto saved = results::deserialize(record::read_events_done(options_.resume, plan_.metadata));
    if (saved.size() > results_.size()) throw FileError(options_.resume + ": holds more events than the catalogue");
    done_ = saved.size();
    for_each_parallel(done_, options_.threads, [&](std::size_t i) {
      results_[i] = evaluate(std::move(plan_.entries[i]), plan_.defaults, plan_.evaluation, std::move(saved[i]));
      is_done_[i] = 1;
    });
  }

  /// Evaluates as many of the next events as a tenth of a second allows, but at least one.
  void advance() {
    const auto start = Clock::now();
    const std::size_t next = std::min<std::size_t>(4096, results_.size() - done_);
    for_each_parallel(
        next, options_.threads,
        [&](std::size_t j) {
          const std::size_t i = done_ + j;
          if (is_done_[i] || (j > 0 && seconds_since(start) > 0.1)) return;
          results_[i] = evaluate(std::move(plan_.entries[i]), plan_.defaults, plan_.evaluation);
          is_done_[i] = 1;
        },
        1);
    while (done_ < results_.size() && is_done_[done_]) ++done_;
  }

  void write() {
    if (!options_.output.wanted()) return;
    const auto begun = Clock::now();
    const auto done = std::span<const EventResult>(results_).first(done_);
    catalogue::Population population;
    for (const EventResult& r : done)
      if (const auto member = results::member_of(r)) population.add(*member);
    record::write_events(finished() ? options_.output.finished() : options_.output.unfinished(), plan_.metadata, done,
                         population.decades(), finished());
    if (finished()) options_.output.clear();
    written_ = Clock::now();
    cost_ = seconds_since(begun);
  }

  /// Whether it is time for a checkpoint. Each writes the whole file, so we limit writing to a small part of the work.
  bool checkpoint_due() const { return seconds_since(written_) > std::max(0.2, 20 * cost_); }
  bool finished() const { return done_ == results_.size(); }
  std::size_t done() const { return done_; }

  std::vector<EventResult> results() && {
    results_.resize(done_);
    return std::move(results_);
  }

 private:
  CataloguePlan plan_;
  const CatalogueOptions& options_;
  std::vector<EventResult> results_;
  std::vector<char> is_done_;  ///< some events after the first `done_` may be done as well
  std::size_t done_ = 0;
  Clock::time_point written_ = Clock::now();
  double cost_ = 0;
};

}  // namespace

std::vector<EventText> texts_of(const std::string& path) {
  std::error_code ignored;
  if (!std::filesystem::is_directory(path, ignored)) return {{path, record::read_text(path)}};
  std::vector<EventText> texts;
  for (const auto& file : std::filesystem::directory_iterator(path, ignored)) {
    EventText text{.name = file.path().string(), .text = {}, .folder = path};
    if (!file.is_regular_file(ignored)) text.error = text.name + ": is not a regular file";
    if (text.error.empty()) try {
        text.text = record::read_text(text.name);
      } catch (const FileError& error) {
        text.error = error.what();
      }
    texts.push_back(std::move(text));
  }
  if (texts.empty()) throw FileError(path + ": a folder without files that can be read");
  std::sort(texts.begin(), texts.end(), [](const auto& a, const auto& b) { return a.name < b.name; });
  return texts;
}

CataloguePlan plan_catalogue(const CatalogueScenario& scenario, int threads, bool with_file) {
  CataloguePlan plan{.entries = {},
                     .columns = {},
                     .defaults = medium::defaults_of(scenario.medium),
                     .evaluation = scenario.evaluation,
                     .metadata = {.version = SLIPFRONT_VERSION,
                                  .command_line = scenario.command_line,
                                  .settings = settings_of(scenario),
                                  .columns = {scenario.evaluation.pulse, scenario.evaluation.sampling.draws}}};
  Entries read = read_all(scenario, plan.defaults);
  plan.entries = std::move(read.all);
  plan.columns = std::move(read.columns);
  plan.metadata.ignored_columns = plan.columns.ignored;
  plan.metadata.ignored_quantities = plan.columns.ignored_quantities;
  results::require_memory(plan.evaluation, plan.entries.size(), threads, with_file);
  plan.disk = results::disk_needed(plan.evaluation, plan.entries.size());
  return plan;
}

CatalogueResult catalogue(CataloguePlan&& plan, const CatalogueOptions& options) {
  record::require_disk_space(options.output.finished(), options.output.wanted() ? plan.disk : 0);
  Evaluation evaluation(std::move(plan), options);
  if (!options.resume.empty())
    evaluation.resume();
  else if (!options.output.replaces())
    evaluation.write();  // so that a path that cannot be written fails before the work
  const auto stopped = [&] { return options.after_step && options.after_step(evaluation.done()); };
  bool stop = stopped();
  while (!evaluation.finished() && !stop) {
    evaluation.advance();
    stop = stopped();
    if (!evaluation.finished() && !stop && evaluation.checkpoint_due()) evaluation.write();
  }
  evaluation.write();
  const bool finished = evaluation.finished();
  return {std::move(evaluation).results(), finished};
}

CatalogueColumns stream_catalogue(const CatalogueScenario& scenario, int threads,
                                  const std::function<void(std::vector<EventResult>&&)>& take) {
  constexpr std::size_t at_once = 4096;
  const medium::Defaults defaults = medium::defaults_of(scenario.medium);
  Entries read = read_all(scenario, defaults);
  results::require_memory(scenario.evaluation, std::min(read.all.size(), at_once), threads);
  for (std::size_t first = 0; first < read.all.size(); first += at_once) {
    std::vector<EventResult> results(std::min(at_once, read.all.size() - first));
    for_each_parallel(
        results.size(), threads,
        [&](std::size_t i) { results[i] = evaluate(std::move(read.all[first + i]), defaults, scenario.evaluation); },
        1);
    take(std::move(results));
  }
  return std::move(read.columns);
}

}  // namespace slipfront::run
