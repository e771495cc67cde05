#include "event_run.hpp"

#include <algorithm>
#include <utility>

#include "batch.hpp"
#include "slipfront/record/text_file.hpp"

using namespace slipfront::event;

/// All events are sampled if the user says how often; those of --json are looked at along the fault.
Plan plan_of(const EventArguments& a) {
  return {{.samples = a.samples.value_or(Sampling{}.samples),
           .seed = a.seed,
           .closure = slipfront::modulation::closure_named(a.closure)},
          a.samples.has_value(),
          a.common.json,
          a.pulse};
}

EventsRead read_all(const EventArguments& a, const Sink& sink,
                    const std::function<void(std::string_view, std::string_view)>& with_text) {
  EventsRead all;
  auto& ignored = all.ignored_columns;
  const auto read = [&](std::string_view text, const std::string& name) {
    with_text(name, text);
    for (std::string& title : read_events(text, name, sink))
      if (std::find(ignored.begin(), ignored.end(), title) == ignored.end()) ignored.push_back(std::move(title));
  };
  if (a.files.empty()) {
    read(shipped_catalogue, "catalogue.csv");
    ignored.clear();  // ours, and known to be ignored
  }
  for (const std::string& file : a.files) {
    try {
      const bool standard_input = file == "-";
      read(standard_input ? slipfront::record::read_standard_input() : slipfront::record::read_text(file),
           standard_input ? "stdin" : file);
    } catch (const slipfront::FileError& error) {
      all.unreadable = true;
      with_text(file, error.what());
      Entry entry;
      entry.observation.name = file;
      entry.observation.file = file;
      entry.error = slipfront::Complaint{.problem = error.what()};
      sink(std::move(entry));
    }
  }
  return all;
}

int exit_code(const EventsRead& read, const EventPrinter& printer) {
  return read.unreadable ? exit_file : printer.errors() > 0 ? exit_input : exit_done;
}

int print_events(const EventArguments& a) {
  const MediumDefaults defaults = defaults_of(a.medium);
  const Plan plan = plan_of(a);
  EventPrinter printer(a.common, {.rows = !a.population, .population = a.population, .pulse = a.pulse});
  std::vector<Entry> waiting;
  const auto flush = [&] {
    auto printed = in_parallel<EventPrinter::Printed>(
        waiting.size(), a.common.threads,
        [&](std::size_t i) { return printer.printed(evaluate(std::move(waiting[i]), defaults, plan)); }, 1);
    waiting.clear();
    for (auto& p : printed) printer.take(std::move(p));
  };
  const EventsRead read = read_all(
      a,
      [&](Entry&& entry) {
        waiting.push_back(std::move(entry));
        if (waiting.size() == 4096) flush();
      },
      [](std::string_view, std::string_view) {});
  flush();
  printer.finish(read.ignored_columns, {});
  return exit_code(read, printer);
}
