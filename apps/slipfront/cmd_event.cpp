#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <map>
#include <memory>

#include "batch.hpp"
#include "commands.hpp"
#include "event_output.hpp"
#include "slipfront/event/read.hpp"
#include "slipfront/record/text_file.hpp"

namespace {

using namespace slipfront::event;

struct Arguments {
  CommonOptions common;
  std::vector<std::string> files;
  StatedMedium medium;
  std::optional<std::size_t> samples;
  std::uint64_t seed = 1;
  std::string closure = "consistent";
  bool pulse = false;
};

/// All events are sampled if the user says how often; those of --json are looked at along the fault.
Plan plan_of(const Arguments& a) {
  return {{.samples = a.samples.value_or(Sampling{}.samples),
           .seed = a.seed,
           .closure = a.closure == "paper" ? slipfront::modulation::Closure::paper
                                           : slipfront::modulation::Closure::consistent},
          a.samples.has_value(),
          a.common.json,
          a.pulse};
}

/// Takes entries as the readers find them, evaluates them by the batch and prints them in order.
class Printer {
 public:
  Printer(const Arguments& arguments)
      : options_(arguments.common), defaults_(defaults_of(arguments.medium)), plan_(plan_of(arguments)) {
    if (options_.json) put("{\"events\": [");
    if (options_.csv) put(event_csv_head(plan_.pulse));
  }

  void take(Entry&& entry) {
    waiting_.push_back(std::move(entry));
    if (waiting_.size() == 4096) flush();
  }

  void finish(const std::vector<std::string>& ignored_columns) {
    flush();
    if (options_.json) {
      put("\n]}\n");
    } else if (!options_.csv && count_ > errors_) {  // a table of nothing but errors would only repeat stderr
      put(event_table_head() + table_);
      if (!options_.quiet) print_notes();
    }
    if (!options_.quiet && !ignored_columns.empty() && !options_.json) {
      std::string line = "note: columns without an observation, ignored:";
      for (const std::string& title : ignored_columns) line += " " + title;
      std::fflush(stdout);
      complain(line);
    }
    if (errors_ > most_errors_shown)
      complain(fmt::format("... and {} more events with errors", errors_ - most_errors_shown));
  }

  std::size_t errors() const { return errors_; }

 private:
  static constexpr std::size_t most_errors_shown = 20;
  struct Printed {
    std::string row, error;
    std::vector<std::string> warnings;
  };

  bool is_table() const { return !options_.json && !options_.csv; }

  void flush() {
    auto printed = in_parallel<Printed>(
        waiting_.size(), options_.threads,
        [&](std::size_t i) {
          const EventResult result = evaluate(std::move(waiting_[i]), defaults_, plan_);
          return Printed{options_.json  ? event_json(result)
                         : options_.csv ? event_csv_row(result, plan_.pulse)
                                        : event_table_row(result) + event_pulse_lines(result),
                         result.error, result.warnings()};
        },
        1);
    waiting_.clear();
    for (Printed& p : printed) {
      if (options_.json) put(count_ == 0 ? "\n" : ",\n");
      if (is_table())
        table_ += p.row;
      else
        put(p.row);
      ++count_;
      for (const std::string& warning : p.warnings) ++warnings_[warning];
      if (!p.error.empty() && ++errors_ <= most_errors_shown) complain(p.error);
    }
  }

  /// Warnings, most frequent first, each once.
  void print_notes() const {
    std::vector<std::pair<std::size_t, std::string>> notes;
    for (const auto& [text, count] : warnings_) notes.emplace_back(count, text);
    std::stable_sort(notes.begin(), notes.end(), [](const auto& a, const auto& b) { return a.first > b.first; });
    if (notes.empty()) return;
    put("\nNotes (--json gives those of each event; --quiet none):\n");
    constexpr std::size_t most = 15;
    for (std::size_t i = 0; i < std::min(notes.size(), most); ++i)
      put(fmt::format("  {} ({} event{})\n", notes[i].second, notes[i].first, notes[i].first == 1 ? "" : "s"));
    if (notes.size() > most) put(fmt::format("  ... and {} more\n", notes.size() - most));
  }

  CommonOptions options_;
  MediumDefaults defaults_;
  Plan plan_;
  std::vector<Entry> waiting_;
  std::size_t count_ = 0, errors_ = 0;
  std::string table_;
  std::map<std::string, std::size_t> warnings_;
};

int run_event(const Arguments& arguments) {
  Printer printer(arguments);
  std::vector<std::string> ignored;
  bool unreadable = false;
  const Sink sink = [&](Entry&& entry) { printer.take(std::move(entry)); };
  const auto read = [&](std::string_view text, const std::string& name) {
    for (std::string& title : read_events(text, name, sink))
      if (std::find(ignored.begin(), ignored.end(), title) == ignored.end()) ignored.push_back(std::move(title));
  };
  if (arguments.files.empty()) {
    read(shipped_catalogue, "catalogue.csv");
    ignored.clear();  // ours, and known to be ignored
  }
  for (const std::string& file : arguments.files) {
    try {
      const bool standard_input = file == "-";
      read(standard_input ? slipfront::record::read_standard_input() : slipfront::record::read_text(file),
           standard_input ? "stdin" : file);
    } catch (const slipfront::FileError& error) {
      unreadable = true;
      Entry entry;
      entry.observation.name = file;
      entry.observation.file = file;
      entry.error = slipfront::Complaint{.problem = error.what()};
      printer.take(std::move(entry));
    }
  }
  printer.finish(ignored);
  return unreadable ? exit_file : printer.errors() > 0 ? exit_input : exit_done;
}

}  // namespace

Runner add_event(CLI::App& app) {
  auto arguments = std::make_shared<Arguments>();
  CLI::App* command =
      app.add_subcommand("event", "Stress, contact ratio and frictionless slip velocity of observed events");
  command->add_option(
      "FILE", arguments->files,
      "Events: .toml (one), .csv (a catalogue), SRCMOD or USGS .fsp, - for stdin; none: the shipped catalogue");
  command
      ->add_option("--p-wave-speed", arguments->medium.p_wave_speed,
                   "For events that give no elastic constants (default: 6 km/s)")
      ->type_name("SPEED");
  command->add_option("--poisson-ratio", arguments->medium.poisson_ratio, "Likewise (default: 0.3)")
      ->type_name("RATIO");
  command->add_option("--shear-modulus", arguments->medium.shear_modulus, "Likewise (default: 30 GPa)")
      ->type_name("MODULUS");
  command
      ->add_option("--samples", arguments->samples,
                   "Sample every event with this many states of the fault (default: 1000 for events that carry an "
                   "uncertainty, a contact ratio, a stress drop or a friction coefficient; 0: none)")
      ->check(CLI::Range(0, 10000000));
  command->add_option("--seed", arguments->seed, "Of the samples (default: 1)");
  command->add_option("--closure", arguments->closure, "Of the friction: consistent (default) or paper")
      ->check(CLI::IsMember({"consistent", "paper"}));
  command->add_flag("--pulse", arguments->pulse,
                    "Run a frictionless pulse through the slip distribution of a .fsp; its front and slip beside the "
                    "model's");
  add_common_options(*command, arguments->common);
  return [arguments] { return run_event(*arguments); };
}
