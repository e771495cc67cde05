#include "event_run.hpp"

#include <algorithm>
#include <utility>

#include "batch.hpp"
#include "slipfront/finite_fault/sources.hpp"
#include "slipfront/record/text_file.hpp"
#include "slipfront/results/memory.hpp"

using namespace slipfront::catalogue;
using namespace slipfront::inference;
using namespace slipfront::finite_fault;
using namespace slipfront::results;

/// All events are sampled if the user says how often; those of --json are looked at along the fault.
EvaluationOptions plan_of(const EventArguments& a) {
  return {{.samples = a.samples.value_or(Sampling{}.samples),
           .seed = a.seed,
           .closure = slipfront::modulation::closure_named(a.closure),
           .draws = a.draws},
          a.samples.has_value(),
          a.common.json,
          a.pulse};
}

std::vector<EventText> texts_of(const EventArguments& a) {
  if (a.files.empty()) return {{"catalogue.csv", std::string(shipped_catalogue), {}}};
  std::vector<EventText> all;
  for (const std::string& file : a.files) try {
      const bool standard_input = file == "-";
      all.push_back({standard_input ? "stdin" : file,
                     standard_input ? slipfront::record::read_standard_input() : slipfront::record::read_text(file),
                     {}});
    } catch (const slipfront::FileError& error) {
      all.push_back({file, {}, error.what()});
    }
  return all;
}

EventsRead read_all(const EventArguments& a, const std::vector<EventText>& texts, const Sink& sink) {
  EventsRead all;
  auto& ignored = all.ignored_columns;
  for (const EventText& t : texts) {
    if (t.error.empty()) {
      for (std::string& title : read_events(t.text, t.name, sink))
        if (std::find(ignored.begin(), ignored.end(), title) == ignored.end()) ignored.push_back(std::move(title));
      continue;
    }
    all.unreadable = true;
    Entry entry;
    entry.observation.name = t.name;
    entry.observation.file = t.name;
    entry.error = slipfront::Complaint{.problem = t.error};
    sink(std::move(entry));
  }
  if (a.files.empty()) ignored.clear();  // ours, and known to be ignored
  return all;
}

int exit_code(const EventsRead& read, const EventPrinter& printer) {
  return read.unreadable ? exit_file : printer.errors() > 0 ? exit_input : exit_done;
}

namespace {

constexpr std::size_t most_waiting = 4096;

}  // namespace

int print_events(const EventArguments& a) {
  const slipfront::medium::Defaults defaults = slipfront::medium::defaults_of(a.medium);
  const EvaluationOptions plan = plan_of(a);
  const std::vector<EventText> texts = texts_of(a);
  Sources sources;  // read twice: whether sources of one earthquake disagree is known when all are
  std::size_t count = 0;
  read_all(a, texts, [&](Entry&& entry) {
    ++count;
    if (!entry.error) sources.add(entry.observation, defaults);
  });
  EventPrinter printer(a.common, {.rows = !a.population, .population = a.population, .pulse = a.pulse});
  std::vector<Entry> waiting;
  require_memory(plan, std::min(count, most_waiting), a.common.threads);
  const auto flush = [&] {
    auto printed = in_parallel<EventPrinter::Printed>(
        waiting.size(), a.common.threads,
        [&](std::size_t i) { return printer.printed(evaluate(std::move(waiting[i]), defaults, plan)); }, 1);
    waiting.clear();
    for (auto& p : printed) printer.take(std::move(p));
  };
  const EventsRead read = read_all(a, texts, [&](Entry&& entry) {
    if (!entry.error) sources.warn(entry.observation);
    waiting.push_back(std::move(entry));
    if (waiting.size() == most_waiting) flush();
  });
  flush();
  printer.finish(read.ignored_columns, {});
  return exit_code(read, printer);
}
