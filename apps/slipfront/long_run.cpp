#include "long_run.hpp"

#include <CLI/CLI.hpp>
#include <cmath>

#include "batch.hpp"

using namespace slipfront;

void add_scenario_options(CLI::App& command, ScenarioArguments& a, bool with_resume) {
  command.add_option("SCENARIO", a.scenario, "Scenario file, TOML")->required();
  command.add_option("-o,--output", a.output, "NetCDF file to write")->type_name("OUT.nc");
  if (with_resume)
    command.add_option("--resume", a.resume, "Go on from a file of this scenario, and write to it")
        ->type_name("OUT.nc");
  command.add_option("--set", a.set, "table.key=value, in place of the scenario's; repeatable")
      ->allow_extra_args(false)
      ->type_name("KEY=VALUE");
  command.add_flag("--check", a.check, "Read, validate, say what would run, and stop");
  add_common_options(command, a.common, false);
}

scenario::Scenario read_scenario_of(const ScenarioArguments& a) {
  scenario::Scenario s =
      scenario::read_scenario(record::read_text(a.scenario), a.scenario, a.set, record::read_profile_table);
  if (!a.common.quiet)
    for (const std::string& warning : s.warnings) complain("warning: " + warning);
  return s;
}

record::Checkpoint checkpoint_of(const ScenarioArguments& a, const scenario::Scenario& s) {
  record::Checkpoint saved = record::read_checkpoint(a.resume);
  const auto refuse = [&](const char* what, const std::string& wanted) {
    throw InputError({.file = a.resume,
                      .key = "--resume",
                      .problem = std::string("was written by another ") + what,
                      .allowed = wanted});
  };
  if (saved.scenario_text != s.text) refuse("scenario", "the scenario that began it, with the same --set");
  if (saved.version != SLIPFRONT_VERSION) refuse("version", "version " SLIPFRONT_VERSION);
  return saved;
}

std::string json_number(double value) { return std::isfinite(value) ? fmt::format("{}", value) : "null"; }

void print_rows(const std::string& title, const std::vector<ResultRow>& rows, const ScenarioArguments& a) {
  if (a.common.json) {
    std::string text = "{";
    for (const auto& row : rows) text += fmt::format("{}\"{}\": {}", text.size() > 1 ? ", " : "", row.key, row.value);
    put(text + "}\n");
    return;
  }
  if (!title.empty()) put(title + "\n");
  for (const auto& row : rows) put(fmt::format("{:<25} {:<24} {}\n", row.key, row.value, row.meaning));
  const std::string& output = a.output.empty() ? a.resume : a.output;
  if (!output.empty() && !a.common.quiet) put("written to " + output + "\n");
}
