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
  return record::read_checkpoint_of(a.resume, s.text, SLIPFRONT_VERSION);
}

std::string json_number(double value) { return std::isfinite(value) ? fmt::format("{}", value) : "null"; }

void print_summary(const std::string& title, const std::vector<setup::SummaryValue>& summary,
                   const ScenarioArguments& a) {
  struct AsJson {
    std::string operator()(double value) const { return json_number(value); }
    std::string operator()(long value) const { return fmt::format("{}", value); }
    std::string operator()(const std::string& value) const { return fmt::format("\"{}\"", value); }
  };
  if (a.common.json) {
    std::string text = "{";
    for (const auto& row : summary)
      text += fmt::format("{}\"{}\": {}", text.size() > 1 ? ", " : "", row.key, std::visit(AsJson{}, row.value));
    put(text + "}\n");
    return;
  }
  if (!title.empty()) put(title + "\n");
  for (const auto& row : summary)
    put(fmt::format("{:<25} {:<24} {}\n", row.key, std::visit(AsJson{}, row.value), row.meaning));
  const std::string& output = a.output.empty() ? a.resume : a.output;
  if (!output.empty() && !a.common.quiet) put("written to " + output + "\n");
}
