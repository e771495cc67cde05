#include <fmt/format.h>

#include <array>
#include <cstddef>
#include <memory>

#include "batch.hpp"
#include "commands.hpp"
#include "json.hpp"
#include "relations_friction.hpp"
#include "si_options.hpp"
#include "slipfront/error.hpp"
#include "slipfront/text/quantity.hpp"
#include "slipfront/theory/medium/medium.hpp"
#include "slipfront/theory/rupture/relations.hpp"
#include "slipfront/theory/rupture/riemann_trains.hpp"
#include "state_values.hpp"
#include "terminal_table.hpp"

namespace {

using slipfront::InputError;
using slipfront::rupture::Relations;
using slipfront::rupture::relations_quantities;
using slipfront::rupture::step_quantities;
using slipfront::rupture::StepRelations;

/// An option that gives states, such as --stress.
struct Given {
  const char* option;
  Relations (*solve)(double);
  slipfront::medium::Dimension dimension;
  const char* unit;  ///< in the model
  std::vector<std::string> texts = {};
  std::size_t used = 0;
  std::optional<Option> parsed = {};
};

struct AskedState {
  const Given* given;
  StateValue at;
};

/// Calls solve(value) for a state. Errors name the line of stdin.
template <class Solve>
auto solved(const AskedState& state, const Solve& solve) {
  try {
    return solve(state.at.value);
  } catch (const InputError& error) {
    slipfront::Complaint complaint = error.complaint();
    complaint.file = state.at.line > 0 ? "stdin" : "command line";
    complaint.line = state.at.line;
    throw InputError(complaint);
  }
}

RelationsUnits units_of(const SiOptions& options, const auto& quantities) {
  const ResultUnits units(options);
  return {units.si(), units.of_each(quantities)};
}

template <class Row>
Row in_units(Row row, const auto& quantities, const RelationsUnits& units) {
  for (std::size_t i = 0; i < units.each.size(); ++i) row.*quantities[i].value *= units.each[i].value;
  return row;
}

template <class Row>
std::string json_row(const Row& row, const auto& quantities) {
  Json json;
  for (const auto& q : quantities) json[std::string(q.about.name)] = row.*q.value;
  return text_of(json);
}

template <class Row>
std::string csv_row(const Row& row, const auto& quantities) {
  std::string text;
  for (const auto& q : quantities) text += fmt::format("{}{}", text.empty() ? "" : ",", row.*q.value);
  return text + "\n";
}

constexpr std::array<TableColumn, 9> relations_columns = {{{12}, {12}, {12}, {12}, {12}, {12}, {12}, {12}, {12}}};

std::vector<std::string> table_row(const Relations& r) {
  std::vector<std::string> cells;
  for (const double value : {r.stress, r.rupture_velocity, r.leading_velocity, r.velocity_ratio, r.slip_velocity,
                             r.stress_at_origin, r.dislocation_velocity_at_origin, r.psi, r.psi_at_origin})
    cells.push_back(fmt::format("{:.6g}", value));
  return cells;
}

std::vector<std::string> table_row(const StepRelations& r) {
  std::vector<std::string> cells;
  for (const double value : {r.stress, r.stress_right, r.rupture_velocity, r.leading_velocity, r.velocity_ratio,
                             r.slip_velocity, r.stress_at_origin, r.dislocation_velocity_at_origin, r.trains_at_origin})
    cells.push_back(fmt::format("{:.6g}", value));
  return cells;
}

template <class Row>
void print_one(const Row& row, const auto& quantities, const RelationsUnits& units) {
  for (std::size_t i = 0; i < units.each.size(); ++i) {
    const auto& q = quantities[i];
    const std::string& unit = units.each[i].name;
    put(fitted(fmt::format("{:<31} {:<20} {}{}{}", q.about.name, row.*q.value, q.about.long_name,
                           unit.empty() ? "" : ", in ", unit),
               31 + 1 + 20 + 1));
  }
}

template <class Row>
void print_json(const std::vector<Row>& results, const auto& quantities, const RelationsUnits& units, int threads) {
  put("{\"relations\": [");
  const auto rows = in_parallel<std::string>(results.size(), threads,
                                             [&](std::size_t i) { return json_row(results[i], quantities); });
  for (std::size_t i = 0; i < rows.size(); ++i) put((i == 0 ? "\n" : ",\n") + rows[i]);
  if (!units.si) return put("\n]}\n");
  Json names;
  for (std::size_t i = 0; i < units.each.size(); ++i)
    if (!units.each[i].name.empty()) names[std::string(quantities[i].about.name)] = units.each[i].name;
  put("\n], \"unit_system\": \"SI\", \"units\": " + text_of(names) + "}\n");
}

template <class Row>
void print_csv(const std::vector<Row>& results, const auto& quantities, int threads) {
  std::string head;
  for (const auto& q : quantities) head += (head.empty() ? "" : ",") + std::string(q.about.name);
  put(head + "\n");
  const auto rows =
      in_parallel<std::string>(results.size(), threads, [&](std::size_t i) { return csv_row(results[i], quantities); });
  for (const std::string& row : rows) put(row);
}

std::vector<std::string> table_titles(const Relations&) {
  return {"stress", "rupture vel", "leading vel", "ratio", "slip vel", "stress(x=0)", "U(x=0)", "psi", "psi(x=0)"};
}
std::vector<std::string> table_titles(const StepRelations&) {
  return {"stress", "ahead", "rupture vel", "leading vel", "ratio", "slip vel", "stress(x=0)", "U(x=0)", "trains(x=0)"};
}

template <class Row>
void print_table(const std::vector<Row>& results, const auto& quantities, const RelationsUnits& units, int threads) {
  TerminalTable table(relations_columns);
  table.add(table_titles(results.front()));
  std::vector<std::string> names;
  for (std::size_t i = 0; i < units.each.size(); ++i) {
    if (quantities[i].about.name == "slip") continue;  // equal to the slip velocity
    names.push_back(quantities[i].about.name == "velocity_ratio" ? "|V- / V+|" : units.each[i].name);
  }
  table.add(std::move(names));
  auto rows = in_parallel<std::vector<std::string>>(results.size(), threads,
                                                    [&](std::size_t i) { return table_row(results[i]); });
  for (auto& row : rows) table.add(std::move(row));
  put(table.text());
}

template <class Row>
int print_relations(std::vector<Row> results, const auto& quantities, const RelationsUnits& units,
                    const CommonOptions& options) {
  for (Row& row : results) row = in_units(row, quantities, units);
  if (options.json)
    print_json(results, quantities, units, options.threads);
  else if (options.csv)
    print_csv(results, quantities, options.threads);
  else if (results.size() == 1)
    print_one(results.front(), quantities, units);
  else
    print_table(results, quantities, units, options.threads);
  return exit_done;
}

int run_closed_forms(const std::vector<AskedState>& states, const FrictionOptions& friction,
                     const SiOptions& si_options, const CommonOptions& options) {
  const RelationsUnits units = units_of(si_options, relations_quantities());
  auto results = in_parallel<Relations>(states.size(), options.threads,
                                        [&](std::size_t i) { return solved(states[i], states[i].given->solve); });
  if (friction.wanted()) {
    print_friction(results, friction, units, options);
    return exit_done;
  }
  return print_relations(std::move(results), relations_quantities(), units, options);
}

/// The pulses from steps of stress into a side with the stress of --stress-right.
int run_steps(const std::vector<AskedState>& states, const std::string& stress_right, const FrictionOptions& friction,
              const SiOptions& si_options, const CommonOptions& options) {
  const auto refuse = [&](std::string problem, std::string allowed) {
    return InputError({.file = "command line",
                       .key = "--stress-right",
                       .value = stress_right,
                       .problem = std::move(problem),
                       .allowed = std::move(allowed)});
  };
  const auto right = slipfront::medium::number(stress_right);
  if (!right) throw refuse("not a stress", "a number, in mu A / pi");
  if (friction.wanted()) throw refuse("without friction only", "no option of friction");
  for (const AskedState& state : states)
    if (std::string_view(state.given->option) != "--stress")
      throw refuse("needs the stress on the left", "only --stress with it, no " + std::string(state.given->option));
  auto results = in_parallel<StepRelations>(states.size(), options.threads, [&](std::size_t i) {
    return solved(states[i], [&](double stress) { return slipfront::rupture::step_relations(stress, *right); });
  });
  return print_relations(std::move(results), step_quantities(), units_of(si_options, step_quantities()), options);
}

/// The number in the unit of the model that a text such as "2.7 km/s" means. It needs the constants of --si; without
/// them, a rupture velocity is that in a rock with the default constants.
double in_model(const Given& given, const std::string& text, const SiOptions& options, bool quiet) {
  const auto refuse = [&](const std::string& problem, const std::string& allowed) {
    return InputError(
        {.file = "command line", .key = given.option, .value = text, .problem = problem, .allowed = allowed});
  };
  const bool is_front = std::string_view(given.unit) == "c";
  if (!options.si && !is_front)
    throw refuse("in SI units it needs --si and --contact-ratio",
                 fmt::format("--si --contact-ratio A, or a number in {}", given.unit));
  slipfront::medium::Span span{};
  try {
    span = slipfront::medium::parse_quantity(text, given.dimension);
  } catch (const InputError& error) {
    throw refuse(error.complaint().problem, error.complaint().allowed);
  }
  if (span.low < span.high) throw refuse("a range, where one number is needed", "first:last:count in the model's unit");
  if (options.si) return span.low / ResultUnits(options).of(given.unit).value;
  const slipfront::medium::Elastic rock = slipfront::medium::elastic({}, {});
  if (!quiet)
    complain(
        fmt::format("note: {} is {:.4g} c, with c = {:.4g} km/s of a p-wave speed of 6 km/s and a Poisson's ratio "
                    "of 0.3; other constants: --si",
                    text, span.low / rock.speed, rock.speed / 1e3));
  return span.low / rock.speed;
}

/// The states of all options, in the order of the command line.
std::vector<AskedState> states_asked_for(const CommandLine& command, std::array<Given, 3>& all, const SiOptions& si,
                                         bool quiet) {
  std::vector<AskedState> states;
  bool stdin_taken = false;
  for (const Option& option : command.given()) {
    for (Given& given : all) {
      if (given.parsed != option) continue;
      const std::string& text = given.texts.at(given.used++);
      const bool from_stdin = text == "-";
      if (from_stdin && stdin_taken)
        throw InputError({.file = "command line",
                          .key = given.option,
                          .value = "-",
                          .problem = "stdin was already read",
                          .allowed = "only one -"});
      stdin_taken = stdin_taken || from_stdin;
      const auto convert = [&](const std::string& quantity) { return in_model(given, quantity, si, quiet); };
      for (const StateValue& at : state_values(text, given.option, convert)) states.push_back({&given, at});
    }
  }
  if (states.empty())
    throw InputError(
        {.file = "command line",
         .problem = "relations: no state is given",
         .allowed = "--stress S, --rupture-velocity V or --slip-velocity W; see slipfront relations --help"});
  return states;
}

std::array<Given, 3> all_given() {
  using slipfront::medium::Dimension;
  return {{{"--stress", slipfront::rupture::from_stress, Dimension::pressure, "mu A / pi"},
           {"--rupture-velocity", slipfront::rupture::from_rupture_velocity, Dimension::velocity, "c"},
           {"--slip-velocity", slipfront::rupture::from_slip_velocity, Dimension::velocity, "c A / pi"}}};
}

}  // namespace

Runner add_relations(CommandLine& program) {
  struct Arguments {
    CommonOptions common;
    FrictionOptions friction;
    SiOptions si;
    std::string stress_right;
    std::array<Given, 3> given = all_given();
  };
  auto arguments = std::make_shared<Arguments>();
  CommandLine command = program.command(
      "relations",
      "Stress, rupture velocity and slip velocity of a frictionless slip pulse, each from any other (Eqs. 8-10). With "
      "friction: the ratio of slip velocities from the friction coefficient, or the reverse (Fig. 10)",
      {"slipfront relations --stress 1.03", "slipfront relations --stress 0.855 --si --contact-ratio 0.003",
       "slipfront relations --rupture-velocity 1e-9:0.9:6:log --csv",
       "slipfront relations --stress 0.855 --stress-right 0.179",
       "slipfront relations --stress 0.855 --slip-velocity-ratio 0.5"});
  const std::array<const char*, 3> help = {"Stress before the rupture, in mu A / pi",
                                           "Velocity of the fast front, in c", "Slip velocity at x = 0, in c A / pi"};
  for (std::size_t i = 0; i < 3; ++i) {
    Given& given = arguments->given[i];
    given.parsed =
        command
            .option(given.option, "VALUE", given.texts,
                    std::string(help[i]) + ", or with a unit; repeatable; a:b:n or a:b:n:log for a range, - for stdin")
            .repeatable();
  }
  command.option("--stress-right", "VALUE", arguments->stress_right,
                 "Stress ahead of the leading front, in mu A / pi, instead of an empty interface; with --stress");
  add_friction_options(command, arguments->friction);
  add_si_options(command, arguments->si);
  add_common_options(command, arguments->common);
  return [arguments, command] {
    const std::vector<AskedState> states =
        states_asked_for(command, arguments->given, arguments->si, arguments->common.quiet);
    if (!arguments->stress_right.empty())
      return run_steps(states, arguments->stress_right, arguments->friction, arguments->si, arguments->common);
    return run_closed_forms(states, arguments->friction, arguments->si, arguments->common);
  };
}
