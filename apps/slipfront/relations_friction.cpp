#include "relations_friction.hpp"

#include <fmt/format.h>

#include <array>
#include <cmath>

#include "batch.hpp"
#include "json.hpp"
#include "slipfront/friction/ratio/table.hpp"
#include "terminal_table.hpp"

namespace {

using slipfront::InputError;
using slipfront::friction::Closure;
using slipfront::rupture::Relations;
namespace friction_ratio = slipfront::friction_ratio;

struct Row {
  double stress, rupture_velocity;
  const char* closure;
  double ratio, ratio_error, damping_number, coefficient, coefficient_error, slip_velocity;
  double front_ratio, stress_drop_share;
};

/// Slip velocity at an observed front, as a fraction of the peak slip velocity. Runs use the same default.
constexpr double threshold = 1e-3;

/// The numbers of a row, with their names in JSON and CSV. The closure is in front of them.
struct FrictionColumn {
  const char* name;
  double Row::*value;
};
constexpr std::array<FrictionColumn, 10> friction_columns = {{{"stress", &Row::stress},
                                                              {"rupture_velocity", &Row::rupture_velocity},
                                                              {"slip_velocity_ratio", &Row::ratio},
                                                              {"slip_velocity_ratio_error", &Row::ratio_error},
                                                              {"damping_number", &Row::damping_number},
                                                              {"friction_coefficient", &Row::coefficient},
                                                              {"friction_coefficient_error", &Row::coefficient_error},
                                                              {"slip_velocity", &Row::slip_velocity},
                                                              {"front_ratio", &Row::front_ratio},
                                                              {"stress_drop_share", &Row::stress_drop_share}}};

Row from_ratio(const Relations& r, Closure closure, const char* name, friction_ratio::SlipVelocityKind measure,
               double ratio, double time) {
  const friction_ratio::Reading reading = friction_ratio::damping_number(measure, closure, r.stress, ratio);
  return {r.stress,
          r.rupture_velocity,
          name,
          ratio,
          0,
          reading.damping_number,
          reading.damping_number / time,
          reading.error / time,
          ratio * r.slip_velocity,
          friction_ratio::front_ratio(closure, r.stress, reading.damping_number, threshold).value,
          stress_drop_share(friction_ratio::Drop::origin, closure, r.stress, reading.damping_number).value};
}

Row from_coefficient(const Relations& r, Closure closure, const char* name, friction_ratio::SlipVelocityKind measure,
                     double coefficient, double time) {
  const double damping = coefficient * time, ratio = evaluate(measure, closure, r.stress, damping).value;
  const double error = ratio * friction_ratio::uncertainty(closure, damping);
  return {r.stress,
          r.rupture_velocity,
          name,
          ratio,
          error,
          damping,
          coefficient,
          0,
          ratio * r.slip_velocity,
          friction_ratio::front_ratio(closure, r.stress, damping, threshold).value,
          stress_drop_share(friction_ratio::Drop::origin, closure, r.stress, damping).value};
}

std::vector<Row> rows_of(const std::vector<Relations>& states, const FrictionOptions& friction) {
  const friction_ratio::SlipVelocityKind measure = friction_ratio::measure_named(friction.measure, "--measure");
  std::vector<Row> rows;
  for (const Relations& r : states)
    for (const auto& [closure, name] : {std::pair{Closure::consistent, "consistent"}, {Closure::paper, "paper"}}) {
      for (const double ratio : friction.ratios)
        rows.push_back(from_ratio(r, closure, name, measure, ratio, friction.time));
      for (const double c : friction.coefficients)
        rows.push_back(from_coefficient(r, closure, name, measure, c, friction.time));
    }
  return rows;
}

/// The unit of a column. That of a pure number is 1 and has no name.
slipfront::medium::UnitInSi unit_of(std::string_view column, const RelationsUnits& units) {
  const auto quantities = slipfront::rupture::relations_quantities();
  for (std::size_t i = 0; i < quantities.size(); ++i)
    if (quantities[i].about.name == column) return units.each[i];
  return {1, ""};
}

void print_json(const std::vector<Row>& rows, const FrictionOptions& friction, const RelationsUnits& units) {
  Json j = {{"measure", friction.measure}, {"time", friction.time}, {"friction", Json::array()}};
  for (const Row& row : rows) {
    Json one = {{"closure", row.closure}};
    for (const FrictionColumn& column : friction_columns) one[column.name] = row.*column.value;
    j["friction"].push_back(one);
  }
  if (units.si) {
    j["unit_system"] = "SI";
    for (const FrictionColumn& column : friction_columns)
      if (const auto unit = unit_of(column.name, units); !unit.name.empty()) j["units"][column.name] = unit.name;
  }
  put(text_of(j) + "\n");
}

void print_csv(const std::vector<Row>& rows) {
  std::string head = "closure";
  for (const FrictionColumn& column : friction_columns) head += std::string(",") + column.name;
  put(head + "\n");
  for (const Row& row : rows) {
    std::string text = row.closure;
    for (const FrictionColumn& column : friction_columns) text += fmt::format(",{}", row.*column.value);
    put(text + "\n");
  }
}

void print_table(const std::vector<Row>& rows, const FrictionOptions& friction, const RelationsUnits& units) {
  static constexpr std::array<TableColumn, 8> table_columns = {
      {{12}, {12}, {12, true, 2}, {12}, {12}, {12}, {9}, {12}}};
  const auto number = [](double value) { return fmt::format("{:.6g}", value); };
  TerminalTable table(table_columns);
  table.add({"stress", "rupture vel", "closure", "W / W(C=0)", "C T", "C", "+- in C", "slip vel"});
  const auto unit = [&](const char* column) { return unit_of(column, units).name; };
  table.add({unit("stress"), unit("rupture_velocity"), "", "", "", "", "", unit("slip_velocity")});
  for (const Row& r : rows)
    table.add({number(r.stress), number(r.rupture_velocity), r.closure, number(r.ratio), number(r.damping_number),
               number(r.coefficient), fmt::format("{:.2g}", r.coefficient_error), number(r.slip_velocity)});
  put(table.text());
  put(
      fitted(fmt::format("measure {}, T = {:.6g} b / (c A); a step of stress into an empty interface: "
                         "docs/friction_ratio.md",
                         friction.measure, friction.time)));
}

/// Adds "command line" to an error for a number out of range.
template <class Make>
auto of_command_line(Make&& make) {
  try {
    return make();
  } catch (const InputError& error) {
    slipfront::Complaint complaint = error.complaint();
    complaint.file = "command line";
    throw InputError(complaint);
  }
}

void check(const char* option, double value, bool zero_too) {
  if (!(value > 0 || (zero_too && value == 0)) || std::isinf(value))
    throw InputError({.file = "command line",
                      .key = option,
                      .value = fmt::format("{}", value),
                      .problem = "out of range",
                      .allowed = zero_too ? ">= 0, finite" : "> 0, finite"});
}

}  // namespace

void add_friction_options(CommandLine& command, FrictionOptions& options) {
  command
      .option("--slip-velocity-ratio", "VALUE", options.ratios,
              "Ratio of the slip velocity with viscous friction to the frictionless one; prints the friction "
              "coefficient C for both closures; repeatable")
      .repeatable();
  command
      .option("--friction-coefficient", "VALUE", options.coefficients,
              "Coefficient C of viscous friction f = C w; prints that ratio; repeatable")
      .repeatable();
  command.option("--time", "T", options.time,
                 "Time T since the rupture began, in b / (c A); only C T matters (default: 2 pi)");
  command.option("--measure", "NAME:{origin,mean,peak,time-mean}", options.measure,
                 "Which slip velocity: origin (x = 0 at T; default), mean, peak or time-mean (slip over duration)");
}

void print_friction(const std::vector<Relations>& states, const FrictionOptions& friction, const RelationsUnits& units,
                    const CommonOptions& options) {
  check("--time", friction.time, false);
  for (const double c : friction.coefficients) check("--friction-coefficient", c, true);
  std::vector<Row> rows = of_command_line([&] { return rows_of(states, friction); });
  for (Row& row : rows)
    for (const FrictionColumn& column : friction_columns) row.*column.value *= unit_of(column.name, units).value;
  if (options.json)
    print_json(rows, friction, units);
  else if (options.csv)
    print_csv(rows);
  else
    print_table(rows, friction, units);
}
