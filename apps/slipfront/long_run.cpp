#include "long_run.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <optional>
#include <system_error>
#include <utility>

#include "batch.hpp"
#include "interrupts.hpp"
#include "json.hpp"
#include "runs/tables.hpp"
#include "system/files/whole_file.hpp"
#include "terminal_table.hpp"

using namespace slipfront;

namespace {

/// Divides the positional arguments into the scenario and further values of one --set, as in --set a.b=1 c.d=2.
void take_words(ScenarioArguments& a, const std::vector<std::string>& words) {
  for (const std::string& word : words) {
    std::error_code none;
    if (word.find('=') != std::string::npos && !std::filesystem::exists(word, none))
      a.more_set.push_back(word);
    else if (a.scenario.empty())
      a.scenario = word;
    else
      a.one_too_many = word;  // reported later, because an unknown option is the better explanation
  }
}

/// The error in the name of an output, as a text for the parser. Empty if there is none.
std::string netcdf_name(const std::string& path) {
  try {
    record::require_netcdf_name(path, "-o");
    return {};
  } catch (const InputError& error) {
    return error.complaint().problem + " '" + path + "'; allowed: " + error.complaint().allowed;
  }
}

}  // namespace

void add_scenario_words(CommandLine& command, ScenarioArguments& a) {
  command
      .arguments(
          "SCENARIO", [&a](const std::vector<std::string>& words) { take_words(a, words); }, "Scenario file, TOML")
      .required();
  command.option("--set", "KEY=VALUE", a.set, "table.key=value, which replaces that of the scenario; repeatable")
      .repeatable();
}

void add_scenario_options(CommandLine& command, ScenarioArguments& a, bool with_resume) {
  add_scenario_words(command, a);
  command
      .option("-o,--output", "OUT.nc", a.output,
              "NetCDF file to write; an existing file is replaced at the end of the run")
      .checked_by(netcdf_name);
  if (with_resume)
    command.option("--resume", "OUT.nc", a.resume,
                   "Resume from a file of this scenario, also to a later time.end, and write to it");
  const Option si = command.flag(
      "--si", a.si, "Results in SI units (default if the scenario has values with units outside of [medium])");
  command.flag("--dimensionless", a.dimensionless, "Results in the units of the model (default otherwise)")
      .excludes(si);
  command.flag("--check", a.check, "Read and check the scenario, print what would run and for how long, and stop");
  add_common_options(command, a.common, false);
}

void require_one_scenario(const ScenarioArguments& a) {
  if (a.scenario.empty() || !a.one_too_many.empty())
    throw InputError({.file = "command line",
                      .key = "SCENARIO",
                      .value = a.one_too_many,
                      .problem = a.scenario.empty() ? "missing" : "a second scenario file",
                      .allowed = "one file"});
}

scenario::Scenario read_scenario_of(const ScenarioArguments& a) {
  require_one_scenario(a);
  return prepared(scenario::read_scenario(record::read_text(a.scenario), a.scenario, settings_of(a), run::read_table),
                  a);
}

std::vector<std::string> settings_of(const ScenarioArguments& a) {
  std::vector<std::string> set = a.set;
  set.insert(set.end(), a.more_set.begin(), a.more_set.end());
  return set;
}

scenario::Scenario prepared(scenario::Scenario s, const ScenarioArguments& a) {
  run::require_inputs_kept(s, a.output);
  run::choose_units(s, a.si || a.dimensionless ? std::optional(a.si) : std::nullopt);
  if (!a.common.quiet)
    for (const std::string& warning : s.warnings) complain("warning: " + warning);
  return s;
}

ProgressWords progress_words(const scenario::Scenario& scenario) {
  if (!scenario.results_in) return {};
  return {.unit = scenario.results_in->of("b / (c A)").value, .name = " s"};
}

namespace {

/// The value and the unit of a column of events.
medium::UnitInSi unit_of(const output::SlipEventColumn& column, const scenario::Scenario& scenario) {
  const bool pulled_end = scenario.loading.where != chain::Pulled::everywhere;
  return scenario.results_in ? scenario.results_in->of(description_of(column, pulled_end).dimensional_unit)
                             : medium::UnitInSi{};
}

/// The events as a table.
std::string table_of(const std::vector<output::SlipEvent>& events, const scenario::Scenario& scenario) {
  std::string count = fmt::format("{} event{}\n", events.size(), events.size() == 1 ? "" : "s");
  if (events.empty()) return count;
  const std::vector<TableColumn> columns(output::slip_event_columns().size(), {.width = 17, .gap = 0});
  TerminalTable table(columns);
  std::vector<std::string> cells;
  for (const auto& column : output::slip_event_columns()) cells.emplace_back(column.key());
  table.add(std::move(cells));
  if (scenario.results_in) {
    cells.clear();
    for (const auto& column : output::slip_event_columns()) cells.push_back(unit_of(column, scenario).name);
    table.add(cells);
  }
  for (const output::SlipEvent& event : events) {
    cells.clear();
    for (const auto& column : output::slip_event_columns())
      cells.push_back(fmt::format("{:.8g}", event.*column.value * unit_of(column, scenario).value));
    table.add(cells);
  }
  std::string text = count + table.text();
  for (const auto& column : columns_without_value(events))
    text += fitted(fmt::format("{} is nan: {}", column.key(), column.about.reason), 2);
  return text;
}

Json json_of_events(const std::vector<output::SlipEvent>& events, const scenario::Scenario& scenario) {
  Json all = Json::array();
  for (const output::SlipEvent& event : events) {
    Json row;
    for (const auto& column : output::slip_event_columns())
      row[std::string(column.key())] = event.*column.value * unit_of(column, scenario).value;
    all.push_back(row);
  }
  return all;
}

/// The object of JSON that holds a row.
Json& object_of(const run::Row& row, Json& all) { return row.group.empty() ? all : all[row.group]; }

Json json_of(const run::Row& row) {
  return std::visit([](const auto& value) { return Json(value); }, row.value);
}

bool has_error(const run::Row& row) {
  return std::any_of(row.errors.begin(), row.errors.end(), [](double error) { return std::isfinite(error); });
}

Json json_of_errors(const run::Row& row) {
  Json errors = Json::array();
  for (const double error : row.errors) errors.push_back(rounded(error));
  return std::holds_alternative<std::vector<double>>(row.value) ? errors : errors.front();
}

/// The units of the rows and of the events, unless they are numbers.
Json json_units(const std::vector<run::Row>& summary, const std::vector<output::SlipEvent>* events,
                const scenario::Scenario& scenario) {
  Json units;
  for (const run::Row& row : summary)
    if (!row.unit.empty()) object_of(row, units)[std::string(row.key())] = row.unit;
  if (!events) return units;
  for (const auto& column : output::slip_event_columns())
    if (const auto unit = unit_of(column, scenario); unit.name != "1")
      units["events"][std::string(column.key())] = unit.name;
  return units;
}

std::string summary_json(const std::vector<run::Row>& summary, const std::vector<std::string>& warnings,
                         const std::vector<output::SlipEvent>* events, const scenario::Scenario& scenario) {
  Json j, errors = Json::object(), reasons = Json::object();
  for (const run::Row& row : summary) {
    const std::string key(row.key());
    object_of(row, j)[key] = json_of(row);
    Json& of_group = object_of(row, errors);
    if (of_group.is_null()) of_group = Json::object();
    if (has_error(row)) of_group[key] = json_of_errors(row);
    if (!row.reason().empty()) reasons[row.group.empty() ? key : row.group + "." + key] = row.reason();
  }
  j["errors"] = errors;
  if (events) {
    j["events"] = json_of_events(*events, scenario);
    for (const auto& column : columns_without_value(*events))
      reasons["events." + std::string(column.key())] = column.about.reason;
  }
  if (!reasons.empty()) j["reasons"] = reasons;
  if (scenario.results_in) {
    j["unit_system"] = "SI";
    j["units"] = json_units(summary, events, scenario);
  }
  j["warnings"] = warnings;
  return text_of(j);
}

/// A value in the table. It has all digits only in lines without a largest width.
struct AsText {
  std::string operator()(double value) const {
    if (!std::isfinite(value)) return "null";
    return terminal_width() ? fmt::format("{:.8g}", value) : fmt::format("{}", value);
  }
  std::string operator()(long value) const { return fmt::format("{}", value); }
  std::string operator()(const std::string& value) const { return fmt::format("\"{}\"", value); }
  std::string operator()(const std::vector<double>&) const { return {}; }
};

/// One line of the table. It ends with the unit, or with the meaning of a number without one. Lines without a largest
/// width have meaning and unit.
void put_line(const std::string& key, const std::string& value, double error, const run::Row& row) {
  const std::string known = std::isfinite(error) ? fmt::format("+- {:.2g}", error) : "";
  const std::size_t digits = terminal_width() ? 13 : 24, errors = terminal_width() ? 10 : 12;
  const bool is_short = terminal_width() && !row.unit.empty();
  const std::string about = is_short ? row.unit : with_reason(row.meaning(), std::string(row.reason()));
  put(fitted(fmt::format("{:<26} {:<{}} {:<{}} {}", key, value, digits, known, errors, about),
             26 + 1 + digits + 1 + errors + 1));
}

/// Whether the row is about something that the run does not have: it has no value, or it is an energy or a pressure
/// that is exactly 0.
bool is_irrelevant(const run::Row& row) {
  const auto* const value = std::get_if<double>(&row.value);
  if (!value) return false;
  const bool may_be_zero =
      row.group == "energies" || row.key().starts_with("energy_") || row.key().starts_with("pore_pressure");
  return !std::isfinite(*value) || (*value == 0 && may_be_zero);
}

std::string name_of(const run::Row& row) { return (row.group.empty() ? "" : row.group + ".") + std::string(row.key()); }

/// The lines of a row. The values of a list are numbered.
void put_row(const run::Row& row) {
  const std::string key = name_of(row);
  const auto* const list = std::get_if<std::vector<double>>(&row.value);
  const auto error = [&](std::size_t i) { return i < row.errors.size() ? row.errors[i] : HUGE_VAL; };
  if (!list) return put_line(key, std::visit(AsText{}, row.value), error(0), row);
  for (std::size_t i = 0; i < list->size(); ++i)
    put_line(fmt::format("{}[{}]", key, i), AsText{}((*list)[i]), error(i), row);
}

/// The rows, and the names of those that are left out.
void put_rows(const std::vector<run::Row>& rows) {
  std::vector<std::string> left_out;
  for (const run::Row& row : rows)
    if (terminal_width() && is_irrelevant(row))
      left_out.push_back(name_of(row));
    else
      put_row(row);
  if (!left_out.empty())
    put(fitted(fmt::format("0 or without a value (--wide prints them, the reasons, and what each number means): {}",
                           fmt::join(left_out, ", ")),
               2));
}

/// Prints the summary of a run as a table or as one JSON object on stdout. Warnings that were not printed before go to
/// stderr. `events` are those of a loaded chain, else null.
void print_summary(const scenario::Scenario& scenario, std::vector<run::Row> summary,
                   const std::vector<std::string>& warnings, const ScenarioArguments& a,
                   const std::vector<output::SlipEvent>* events) {
  if (scenario.results_in) run::convert(summary, *scenario.results_in);
  const std::vector<std::string>& printed = scenario.warnings;
  if (!a.common.quiet)
    for (const std::string& warning : warnings)
      if (std::find(printed.begin(), printed.end(), warning) == printed.end()) complain("warning: " + warning);
  if (a.common.json) {
    put(summary_json(summary, warnings, events, scenario) + "\n");
    return;
  }
  if (!scenario.title.empty()) put(fitted(scenario.title));
  put_rows(summary);
  if (events) put(table_of(*events, scenario));
  const std::string& output = a.output.empty() ? a.resume : a.output;
  if (!output.empty() && !a.common.quiet) put(fitted("written to " + output));
}

/// Carries out a plan and shows its progress. Meanwhile Ctrl-C interrupts the run.
run::Result with_progress(const ScenarioArguments& a, const run::Plan& plan, run::Options options) {
  const bool first = the_ranks->rank() == 0;
  const record::Output& output = options.output;
  if (output.wanted())
    interrupted_means("; the last checkpoint is saved: continue with " + output.how_to_resume(), output.unfinished());
  const WatchInterrupts watch(!first);
  std::optional<Progress> progress;
  options.after_step = [&](double time, long steps) {
    if (!progress) {
      progress.emplace(plan.scenario.end, first && !a.common.quiet, std::string(), progress_words(plan.scenario));
      progress->from(time, steps);
    }
    progress->at(time, steps);
    return interrupted_by_user();
  };
  return run::carry_out(plan, options);
}

/// Whether processes can share a run of this solver.
bool is_shared(scenario::SolverKind solver) {
  return solver == scenario::SolverKind::chain || solver == scenario::SolverKind::plane_direct;
}

/// How long a run would take, as a sentence.
std::string duration_in_words(const run::Plan& plan, const run::Options& options, const run::Result& begun) {
  const run::Duration duration = run::expected_duration(begun, plan, options);
  std::string machine = " on this machine";
  if (options.ranks) machine += fmt::format(" with {} processes", options.ranks->size());
  if (plan.solver != scenario::SolverKind::pulse)
    machine +=
        fmt::format(" {} {} thread{}", options.ranks ? "of" : "with", options.threads, options.threads == 1 ? "" : "s");
  if (std::isnan(duration.seconds))
    return fmt::format("How long it takes depends on its slip events: 1000 steps take {}{}.",
                       in_words(1000 * duration.of_a_step), machine);
  const bool by_events = plan.chain.implicit && !begun.finished();
  return fmt::format("It would take {}{}{}.", in_words(duration.seconds), machine,
                     by_events ? " if its slip events remain as frequent" : "");
}

}  // namespace

std::string in_words(double seconds) {
  constexpr double minute = 60, hour = 60 * minute, day = 24 * hour;
  const auto in = [&](double unit, const char* name) { return fmt::format("about {:.2g} {}", seconds / unit, name); };
  if (seconds < 1) return "less than 1 s";
  if (seconds < 95) return in(1, "s");
  if (seconds < 95 * minute) return in(minute, "min");
  return seconds < 2 * day ? in(hour, "h") : in(day, "days");
}

std::string parameters_in_words(const friction::Friction& friction) {
  std::string text;
  for (const friction::Parameter& p : friction.definition().parameters) {
    const double value = friction.parameter(p.name);
    if (value == 0 && p.value == 0 && p.words.empty() && !text.empty()) continue;  // it has no effect
    const std::string words =
        p.words.empty() ? fmt::format("{:.6g}", value) : std::string(p.words.at(static_cast<std::size_t>(value)));
    text += fmt::format("{}{} = {}", text.empty() ? " with " : ", ", p.name, words);
  }
  return fmt::format("{} friction{}", friction.definition().adjective, text);
}

int plan_and_run(const ScenarioArguments& a, Clock::time_point begun, const std::function<run::Plan()>& make_plan,
                 const std::function<std::string(const run::Plan&, const output::Run&)>& in_words) {
  run::Plan plan;
  the_ranks->together([&] { plan = make_plan(); });  // so that an error is reported only once
  const scenario::Scenario& s = plan.scenario;
  the_ranks->require_same("SCENARIO", s.text);
  const Ranks* const ranks = is_shared(plan.solver) && the_ranks->size() > 1 ? the_ranks : nullptr;
  if (!ranks && the_ranks->rank() > 0) return exit_done;
  run::Options options{.threads = a.common.threads, .ranks = ranks, .begun = begun};
  const auto prepare = [&] {
    if (!a.resume.empty()) options.checkpoint = run::checkpoint_of(a.resume, plan);
    options.output = run::output_of(a.output, a.resume, options.checkpoint && options.checkpoint->finished);
    if (a.check) record::require_disk_space(options.output.finished(), plan.need.disk);
  };
  ranks ? ranks->together(prepare) : prepare();
  if (ranks) ranks->require_same("--resume", options.checkpoint ? options.checkpoint->solver_state : "");
  const bool first = the_ranks->rank() == 0;
  if (a.check) {
    const run::Result start = run::begin(plan, options);
    const std::string would = in_words(plan, *start.run), duration = duration_in_words(plan, options, start);
    if (first)
      put(fitted(
          fmt::format("{}: OK. This scenario would {}. {}", s.title.empty() ? s.file : s.title, would, duration)));
    return exit_done;
  }
  run::Result result = with_progress(a, plan, options);
  if (!result.finished()) {
    const std::string how = options.output.wanted() ? fmt::format("interrupted at t = {}; continue with {}",
                                                                  s.in_results(result.run->time(), "b / (c A)"),
                                                                  options.output.how_to_resume())
                                                    : "interrupted; there is no checkpoint, because -o was not given";
    if (first) complain(how);
    return exit_interrupted;
  }
  std::vector<std::string> warnings = result.metadata.warnings;
  if (result.add_errors)
    for (std::string& warning : result.add_errors(result.summary, {})) warnings.push_back(std::move(warning));
  const std::vector<output::SlipEvent> events = result.events ? result.events() : std::vector<output::SlipEvent>{};
  if (first) print_summary(s, result.summary, warnings, a, result.events ? &events : nullptr);
  return exit_done;
}
