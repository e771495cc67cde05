#include <fmt/format.h>

#include <filesystem>
#include <string_view>
#include <system_error>
#include <utility>

#include "event_keep.hpp"
#include "event_output.hpp"
#include "event_run.hpp"
#include "slipfront/finite_fault/sources.hpp"
#include "slipfront/record/text_file.hpp"
#include "slipfront/results/memory.hpp"

using namespace slipfront::catalogue;
using namespace slipfront::inference;
using namespace slipfront::finite_fault;
using namespace slipfront::results;

namespace {

bool is_csv(const std::string& path) { return std::string_view(path).ends_with(".csv"); }

/// \throws InputError for a file that is neither NetCDF nor CSV by its name, or that the events are read from.
void check_names(const EventArguments& a) {
  const auto refuse = [](const char* option, const std::string& value, const char* allowed) {
    throw slipfront::InputError({.file = "command line",
                                 .key = option,
                                 .value = value,
                                 .problem = "cannot be such a file",
                                 .allowed = allowed});
  };
  const auto is_netcdf = [](const std::string& path) { return std::string_view(path).ends_with(".nc"); };
  if (!a.output.empty() && !is_netcdf(a.output) && !is_csv(a.output)) refuse("-o", a.output, "OUT.nc or OUT.csv");
  std::error_code not_there;
  for (const std::string& file : a.files)
    if (std::filesystem::equivalent(file, a.output, not_there)) refuse("-o", a.output, "another file than those read");
  if (!a.resume.empty() && !is_netcdf(a.resume)) refuse("--resume", a.resume, "OUT.nc, as -o wrote it");
  if (a.draws > 0 && is_csv(a.output)) refuse("-o", a.output, "OUT.nc, with --draws");
  if (!a.resume.empty() && is_csv(a.output)) refuse("-o", a.output, "OUT.nc, with --resume");
}

/// What makes the results what they are; threads do not.
std::vector<std::pair<std::string, std::string>> settings_of(const EventArguments& a, const EvaluationOptions& plan,
                                                             const std::string& inputs) {
  const auto stated = [](const std::string& text) { return text.empty() ? "default" : text; };
  return {{"seed", fmt::format("{}", plan.sampling.seed)},
          {"samples", fmt::format("{}", plan.sampling.samples)},
          {"sampled_events", plan.sample_all ? "all" : "those that speak of friction or errors"},
          {"closure", a.closure},
          {"pulse", a.pulse ? "yes" : "no"},
          {"posterior_draws", fmt::format("{}", a.draws)},
          {"p_wave_speed", stated(a.medium.p_wave_speed)},
          {"poisson_ratio", stated(a.medium.poisson_ratio)},
          {"shear_modulus", stated(a.medium.shear_modulus)},
          {"input_checksum", inputs}};
}

std::string command_line_of(const EventArguments& a) {
  std::string line = "slipfront event";
  for (const std::string& file : a.files) line += " " + file;
  return line;
}

void write_rows(const std::string& path, const std::vector<EventResult>& results, bool with_pulse) {
  std::string text = event_csv_head(with_pulse);
  for (const EventResult& r : results) text += event_csv_row(r, with_pulse);
  slipfront::record::write_text(path, text);
}

}  // namespace

int write_events(const EventArguments& a) {
  check_names(a);
  const slipfront::medium::Defaults defaults = slipfront::medium::defaults_of(a.medium);
  const EvaluationOptions plan = plan_of(a);
  std::vector<Entry> entries;
  std::string inputs;
  const std::vector<EventText> texts = texts_of(a);
  for (const EventText& t : texts)
    inputs = slipfront::record::checksum_of_inputs(inputs, t.name, t.error.empty() ? t.text : t.error);
  const EventsRead read = read_all(a, texts, [&](Entry&& entry) { entries.push_back(std::move(entry)); });
  warn_of_other_sources(entries, defaults);
  const std::size_t total = entries.size();
  require_memory(plan, total, a.common.threads, true);
  const std::string& path = a.output.empty() ? a.resume : a.output;
  const slipfront::record::Output output(is_csv(path) ? "" : path, a.resume);
  slipfront::record::require_disk_space(path, disk_needed(plan, total));
  const KeptEvents kept = evaluate_and_keep(
      std::move(entries), defaults, plan,
      {.output = output,
       .resume = a.resume,
       .metadata = {SLIPFRONT_VERSION, command_line_of(a), settings_of(a, plan, inputs), {a.pulse, a.draws}},
       .threads = a.common.threads,
       .quiet = a.common.quiet});
  if (!kept.finished) {
    complain(fmt::format(
        "interrupted after {} of {} events; {}", kept.results.size(), total,
        is_csv(path) ? "nothing was written: -o OUT.nc could be resumed" : "go on with " + output.how_to_resume()));
    return exit_interrupted;
  }
  if (is_csv(path)) write_rows(path, kept.results, a.pulse);
  EventPrinter printer(a.common, {.rows = false, .population = a.population, .pulse = a.pulse});
  for (const EventResult& result : kept.results) printer.take(printer.printed(result));
  printer.finish(read.ignored_columns, path);
  return exit_code(read, printer);
}
