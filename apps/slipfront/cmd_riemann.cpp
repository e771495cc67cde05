#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <functional>
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
#include "slipfront/text/quantity.hpp"
#include "slipfront/theory/rupture/riemann.hpp"
#include "slipfront/theory/rupture/riemann_trains.hpp"
#include "slipfront/theory/train.hpp"
#include "terminal_table.hpp"

namespace {

using slipfront::InputError;
using slipfront::State;
using slipfront::rupture::ProfilePoint;
using slipfront::rupture::ProfileQuantity;
using slipfront::rupture::Region;
using slipfront::rupture::TrainsPoint;
using slipfront::rupture::Wave;

struct RiemannArguments {
  CommonOptions common;
  SiOptions si;
  std::string left, right, solution = "trains";
  int points = 201;
};

/// Either solution. Only the exact one has regions, slip and trains.
struct Shown {
  bool exact;
  State left, right;
  TrainsPoint star;
  Wave left_wave, right_wave;
  slipfront::rupture::Edges edges;
  std::vector<Region> regions;
  std::function<TrainsPoint(double)> at;
};

Shown with_trains(const State& left, const State& right) {
  const auto s = slipfront::rupture::solve_trains(left, right);
  return {true,
          left,
          right,
          slipfront::rupture::profile_point(s.star),
          s.left_wave,
          s.right_wave,
          slipfront::rupture::edges_of(s),
          s.regions,
          [s](double x) { return slipfront::rupture::profile_point(s, x); }};
}

/// The averages of one train, without slip.
TrainsPoint point_of(const State& state) {
  return {slipfront::rupture::profile_point(state), 0, slipfront::train::averages(state).H, {}};
}

Shown with_shocks(const State& left, const State& right) {
  const auto s = slipfront::rupture::solve_riemann(left, right);
  return {false,
          left,
          right,
          point_of(s.star),
          s.left_wave,
          s.right_wave,
          slipfront::rupture::edges_of(s),
          {},
          [s](double x) { return point_of(slipfront::rupture::sample(s, x)); }};
}

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

Json riemann_json(const ProfilePoint& point, const RiemannUnits& units) {
  Json json;
  const std::vector<double> values = values_of(point, units);
  for (std::size_t i = 0; i < values.size(); ++i)
    json[std::string(slipfront::rupture::profile_quantities()[i].about.name)] = values[i];
  return json;
}

Json riemann_json(const Wave& wave, double c) {
  return {{"kind", slipfront::rupture::name_of(wave.kind)}, {"outer", wave.outer * c}, {"inner", wave.inner * c}};
}

/// The units of stress and of slip velocity among those of profile_quantities().
constexpr std::size_t of_stress = 1, of_slip_velocity = 2;

Json riemann_json(const TrainsPoint& point, const RiemannUnits& units) {
  const double stress = units.each[of_stress].value, slip_velocity = units.each[of_slip_velocity].value;
  Json each = Json::array();
  for (const auto& train : point.trains)
    each.push_back({{"Sigma", train.Sigma * stress},
                    {"W", train.W * slip_velocity},
                    {"lowest_rapidity", train.lowest},
                    {"highest_rapidity", train.highest}});
  return {{"stress", point.all.Sigma * stress},
          {"slip_velocity", point.all.W * slip_velocity},
          {"trains", point.trains.size()},
          {"each", std::move(each)}};
}

constexpr const char* shocks_depend_on_the_frame =
    "shocks by dislocations and momentum depend on the frame of reference, and the equations without friction do not: "
    "this is an approximation";

bool has_shocks(const Shown& s) {
  return s.left_wave.kind == Wave::Kind::shock || s.right_wave.kind == Wave::Kind::shock;
}

void print_json(const Shown& s, const RiemannUnits& units) {
  const double c = units.c.value;
  Json json = {{"left", riemann_json(slipfront::rupture::profile_point(s.left), units)},
               {"star", riemann_json(s.star.all, units)},
               {"right", riemann_json(slipfront::rupture::profile_point(s.right), units)},
               {"left_wave", riemann_json(s.left_wave, c)},
               {"right_wave", riemann_json(s.right_wave, c)},
               {"left_edge", s.edges.left * c},
               {"right_edge", s.edges.right * c},
               {"solution", s.exact ? "trains" : "shocks"},
               {"warnings", Json::array()}};
  if (has_shocks(s)) json["warnings"].push_back(shocks_depend_on_the_frame);
  if (s.exact) {
    json["waves"] = Json::array();
    for (const Region& region : s.regions)
      json["waves"].push_back({{"kind", slipfront::rupture::name_of(region.kind)},
                               {"from", region.from * c},
                               {"to", region.to * c},
                               {"trains", region.trains}});
    json["at_origin"] = riemann_json(s.at(0), units);
  }
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
void print_csv(const Shown& s, const RiemannUnits& units, int points) {
  std::string head = "x_over_t";
  for (const ProfileQuantity& quantity : slipfront::rupture::profile_quantities())
    head += "," + std::string(quantity.about.name);
  put(head + (s.exact ? ",slip,trains,Sigma_1,W_1,Sigma_2,W_2\n" : "\n"));
  const auto [left, right] = s.edges;
  for (int i = 0; i < points; ++i) {
    const double x = left + (right - left) * (1.5 * i / (points - 1) - 0.25);
    const TrainsPoint point = s.at(x);
    std::string row = fmt::format("{}", x * units.c.value);
    for (const double value : values_of(point.all, units)) row += fmt::format(",{}", value);
    if (s.exact) {
      const double stress = units.each[of_stress].value, slip_velocity = units.each[of_slip_velocity].value;
      row += fmt::format(",{},{}", point.slip * slip_velocity, point.trains.size());
      for (const auto& train : point.trains)
        row += fmt::format(",{},{}", train.Sigma * stress, train.W * slip_velocity);
      for (std::size_t train = point.trains.size(); train < 2; ++train) row += ",,";
    }
    put(row + "\n");
  }
}

void print_origin(const TrainsPoint& origin, const RiemannUnits& units) {
  const std::size_t count = origin.trains.size();
  put(fitted(fmt::format("at x = 0: {}, Sigma = {:.6g}, W = {:.6g}",
                         count == 0   ? "no dislocations"
                         : count == 1 ? "one train"
                                      : "two trains",
                         origin.all.Sigma * units.each[of_stress].value,
                         origin.all.W * units.each[of_slip_velocity].value)));
}

void print_table(const Shown& s, const RiemannUnits& units) {
  static constexpr std::array<TableColumn, 7> riemann_columns = {
      {{10, true}, {12}, {12}, {13, false}, {12}, {12}, {12}}};
  const double c = units.c.value;
  const auto number = [](double value) { return fmt::format("{:.6g}", value); };
  TerminalTable table(riemann_columns);
  std::vector<std::string> titles = {"", "x/t from", "to"}, names = {"", units.c.name, units.c.name};
  for (const ProfileQuantity& quantity : slipfront::rupture::profile_quantities())
    titles.emplace_back(quantity.about.name);
  for (const auto& unit : units.each) names.push_back(unit.name);
  table.add(std::move(titles));
  table.add(std::move(names));
  const auto add = [&](std::string_view region, std::string from, std::string to, const ProfilePoint* point) {
    std::vector<std::string> cells = {std::string(region), std::move(from), std::move(to)};
    if (point != nullptr)
      for (const double value : values_of(*point, units)) cells.push_back(number(value));
    table.add(std::move(cells));
  };
  const auto add_wave = [&](const Wave& wave) {
    const double first = std::min(wave.outer, wave.inner) * c, last = std::max(wave.outer, wave.inner) * c;
    if (wave.kind != Wave::Kind::none)
      add(slipfront::rupture::name_of(wave.kind), number(first), number(last), nullptr);
  };
  const ProfilePoint left = slipfront::rupture::profile_point(s.left),
                     right = slipfront::rupture::profile_point(s.right);
  if (s.left_wave.kind == Wave::Kind::none && s.right_wave.kind == Wave::Kind::none) {
    add("all", "", "", &left);
    return put(table.text());
  }
  add("left", "", number(s.edges.left * c), &left);
  add_wave(s.left_wave);
  if (!s.left.empty() && !s.right.empty() && s.left_wave.inner < s.right_wave.inner)
    add("between", number(s.left_wave.inner * c), number(s.right_wave.inner * c), &s.star.all);
  add_wave(s.right_wave);
  add("right", number(s.edges.right * c), "", &right);
  put(table.text());
  if (has_shocks(s)) put(fitted(shocks_depend_on_the_frame));
  if (s.exact) print_origin(s.at(0), units);
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
  const Shown solution = arguments.solution == "shocks" ? with_shocks(left, right) : with_trains(left, right);
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
      "The motion without friction if two uniform trains of dislocations meet: the exact Riemann problem. Where "
      "dislocations overtake each other, there are two trains at one position",
      {"slipfront riemann --left 0.855 --right 0", "slipfront riemann --left 2,0.3 --right 0.5,-0.2",
       "slipfront riemann --left 1 --right 0.5 --csv --points 400",
       "slipfront riemann --left 1 --right 0.5 --solution shocks",
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
  command
      .option("--solution", "KIND", arguments->solution,
              "trains: exact. shocks: one train at each position, with shocks that conserve dislocations and momentum, "
              "as in pulse; an approximation that depends on the frame of reference (default: trains)")
      .one_of({"trains", "shocks"});
  add_si_options(command, arguments->si);
  add_common_options(command, arguments->common);
  return [arguments] { return run_riemann(*arguments); };
}
