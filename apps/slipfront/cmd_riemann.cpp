#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "batch.hpp"
#include "commands.hpp"
#include "json.hpp"
#include "si_options.hpp"
#include "slipfront/error.hpp"
#include "slipfront/medium/quantity.hpp"
#include "slipfront/rupture/riemann.hpp"
#include "terminal_table.hpp"

namespace {

using slipfront::InputError;
using slipfront::State;
using slipfront::rupture::ProfilePoint;
using slipfront::rupture::ProfileQuantity;
using slipfront::rupture::RiemannSolution;
using slipfront::rupture::Wave;

struct RiemannArguments {
  CommonOptions common;
  SiOptions si;
  std::string left, right;
  int points = 201;
};

/// The train of an option STRESS[,U]. `side` is left or right.
State train_of(const std::string& text, const std::string& side) {
  const auto refuse = [&](std::string problem, std::string allowed) {
    return InputError({.file = "command line",
                       .key = "--" + side,
                       .value = text,
                       .problem = std::move(problem),
                       .allowed = std::move(allowed)});
  };
  const std::size_t comma = text.find(',');
  const auto stress = slipfront::medium::number(std::string_view(text).substr(0, comma));
  const auto velocity = comma == std::string::npos
                            ? std::optional(0.0)
                            : slipfront::medium::number(std::string_view(text).substr(comma + 1));
  if (!stress || !velocity)
    throw refuse("not a stress, or a stress and a velocity", "STRESS or STRESS,U, such as 0.5 or 0.5,-0.1");
  try {
    return slipfront::rupture::moving_train(*stress, *velocity, side);
  } catch (const InputError& error) {
    const slipfront::Complaint& complaint = error.complaint();
    const bool of_stress = complaint.key == side + "_stress";
    throw refuse(std::string(of_stress ? "stress" : "velocity") + " out of range", complaint.allowed);
  }
}

/// The units of the results: that of velocities, and those of profile_quantities().
struct RiemannUnits {
  explicit RiemannUnits(const ResultUnits& units)
      : si(units.si()), c(units.of("c")), each(units.of_each(slipfront::rupture::profile_quantities())) {}
  bool si;
  slipfront::medium::UnitInSi c;
  std::vector<slipfront::medium::UnitInSi> each;
};

/// The values of profile_quantities() in the units of the results.
std::vector<double> values_of(const ProfilePoint& point, const RiemannUnits& units) {
  std::vector<double> values;
  for (std::size_t i = 0; i < units.each.size(); ++i)
    values.push_back(point.*slipfront::rupture::profile_quantities()[i].value * units.each[i].value);
  return values;
}

Json riemann_json(const State& state, const RiemannUnits& units) {
  Json json;
  const std::vector<double> values = values_of(slipfront::rupture::profile_point(state), units);
  for (std::size_t i = 0; i < values.size(); ++i)
    json[std::string(slipfront::rupture::profile_quantities()[i].about.name)] = values[i];
  return json;
}

Json riemann_json(const Wave& wave, double c) {
  return {{"kind", slipfront::rupture::name_of(wave.kind)}, {"outer", wave.outer * c}, {"inner", wave.inner * c}};
}

void print_json(const RiemannSolution& s, const RiemannUnits& units) {
  const double c = units.c.value;
  const auto [left_edge, right_edge] = slipfront::rupture::edges_of(s);
  Json json = {{"left", riemann_json(s.left, units)},
               {"star", riemann_json(s.star, units)},
               {"right", riemann_json(s.right, units)},
               {"left_wave", riemann_json(s.left_wave, c)},
               {"right_wave", riemann_json(s.right_wave, c)},
               {"left_edge", left_edge * c},
               {"right_edge", right_edge * c}};
  if (units.si) {
    json["unit_system"] = "SI";
    for (std::size_t i = 0; i < units.each.size(); ++i)
      if (!units.each[i].name.empty())
        json["units"][std::string(slipfront::rupture::profile_quantities()[i].about.name)] = units.each[i].name;
    json["units"]["edges"] = units.c.name;
  }
  put(text_of(json) + "\n");
}

/// The solution over x/t, from a quarter of its width on the left of its left edge to as much on the right.
void print_csv(const RiemannSolution& s, const RiemannUnits& units, int points) {
  std::string head = "x_over_t";
  for (const ProfileQuantity& quantity : slipfront::rupture::profile_quantities())
    head += "," + std::string(quantity.about.name);
  put(head + "\n");
  const auto [left, right] = slipfront::rupture::edges_of(s);
  for (int i = 0; i < points; ++i) {
    const double x = left + (right - left) * (1.5 * i / (points - 1) - 0.25);
    std::string row = fmt::format("{}", x * units.c.value);
    for (const double value : values_of(slipfront::rupture::profile_point(s, x), units))
      row += fmt::format(",{}", value);
    put(row + "\n");
  }
}

void print_table(const RiemannSolution& s, const RiemannUnits& units) {
  static constexpr std::array<TableColumn, 7> riemann_columns = {
      {{8, true}, {12}, {12}, {13, false}, {12}, {12}, {12}}};
  const double c = units.c.value;
  const auto number = [](double value) { return fmt::format("{:.6g}", value); };
  const auto [left_edge, right_edge] = slipfront::rupture::edges_of(s);
  TerminalTable table(riemann_columns);
  std::vector<std::string> titles = {"", "x/t from", "to"}, names = {"", units.c.name, units.c.name};
  for (const ProfileQuantity& quantity : slipfront::rupture::profile_quantities())
    titles.emplace_back(quantity.about.name);
  for (const auto& unit : units.each) names.push_back(unit.name);
  table.add(std::move(titles));
  table.add(std::move(names));
  const auto add = [&](std::string_view region, std::string from, std::string to, const State* state) {
    std::vector<std::string> cells = {std::string(region), std::move(from), std::move(to)};
    if (state != nullptr)
      for (const double value : values_of(slipfront::rupture::profile_point(*state), units))
        cells.push_back(number(value));
    table.add(std::move(cells));
  };
  const auto add_wave = [&](const Wave& wave) {
    const double first = std::min(wave.outer, wave.inner) * c, last = std::max(wave.outer, wave.inner) * c;
    if (wave.kind != Wave::Kind::none)
      add(slipfront::rupture::name_of(wave.kind), number(first), number(last), nullptr);
  };
  if (s.left_wave.kind == Wave::Kind::none && s.right_wave.kind == Wave::Kind::none) {
    add("all", "", "", &s.left);
    return put(table.text());
  }
  add("left", "", number(left_edge * c), &s.left);
  add_wave(s.left_wave);
  if (!s.left.empty() && !s.right.empty() && s.left_wave.inner < s.right_wave.inner)
    add("between", number(s.left_wave.inner * c), number(s.right_wave.inner * c), &s.star);
  add_wave(s.right_wave);
  add("right", number(right_edge * c), "", &s.right);
  put(table.text());
}

int run_riemann(const RiemannArguments& arguments) {
  const State left = train_of(arguments.left, "left"), right = train_of(arguments.right, "right");
  if (left.empty() && right.empty())
    throw InputError({.file = "command line",
                      .key = "--left",
                      .value = arguments.left,
                      .problem = "both sides are empty",
                      .allowed = "a stress above 0 on one side"});
  const RiemannUnits units{ResultUnits(arguments.si)};
  const RiemannSolution solution = slipfront::rupture::solve_riemann(left, right);
  if (arguments.common.json)
    print_json(solution, units);
  else if (arguments.common.csv)
    print_csv(solution, units, arguments.points);
  else
    print_table(solution, units);
  return exit_done;
}

}  // namespace

Runner add_riemann(CommandLine& program) {
  auto arguments = std::make_shared<RiemannArguments>();
  CommandLine command = program.command(
      "riemann",
      "The motion without friction if two uniform trains of dislocations meet: the exact Riemann problem. Each wave "
      "is a fan or a shock",
      {"slipfront riemann --left 0.855 --right 0", "slipfront riemann --left 2,0.3 --right 0.5,-0.2",
       "slipfront riemann --left 1 --right 0.5 --csv --points 400",
       "slipfront riemann --left 1 --right 0.5 --si --contact-ratio 0.003"});
  const auto add = [&](const char* name, std::string& text, const char* side) {
    command
        .option(name, "STRESS[,U]", text,
                std::string("Train on the ") + side +
                    ": its stress in mu A / pi, and the velocity U of its dislocations in c (default: 0). A "
                    "stress of 0 is the empty interface")
        .required();
  };
  add("--left", arguments->left, "left");
  add("--right", arguments->right, "right");
  command.option("--points", "N", arguments->points, "Number of rows of --csv (default: 201)").in_range(2, 10000000);
  add_si_options(command, arguments->si);
  add_common_options(command, arguments->common);
  return [arguments] { return run_riemann(*arguments); };
}
