// The tables of a scenario on a plane.

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <functional>
#include <limits>
#include <memory>
#include <numbers>
#include <optional>
#include <utility>
#include <vector>

#include "math/digits.hpp"
#include "scenario/formula.hpp"
#include "scenario/functions.hpp"
#include "scenario/readers.hpp"
#include "scenario/solver_errors.hpp"
#include "slipfront/error.hpp"
#include "slipfront/lattice/plane/solvers.hpp"
#include "slipfront/scenario/problem.hpp"
#include "system/machine.hpp"
#include "system/ranks.hpp"

namespace slipfront::scenario {

namespace {

/// The slip of the table that the key "file" names, with columns r and slip. Inside its first r the slip is that of the
/// first row. It must end with the slip 0, and is 0 outside. `ratio` is y of the scenario over y of the problem.
std::function<double(double, double)> read_radial(const Section& section, const TableReader& tables, double ratio) {
  const Column radius{"r", {.least = 0, .most = farthest}, section.in_file(ModelUnit::position)};
  const Column slip{"slip", {.least = 0}, section.in_file(ModelUnit::slip)};
  const auto rows = TableFile(section, tables).rows(radius, slip);
  if (rows.back().second != 0)
    throw section.refuse("file", "its last row has the slip " + shortest(rows.back().second),
                         "0 in the last row, where the rupture ends");
  const auto curve = std::make_shared<const MonotoneCurve>(rows);
  return [curve, ratio](double x, double y) {
    const double r = std::hypot(x, ratio * y);
    if (r >= curve->last()) return 0.0;
    return (*curve)(std::fmax(r, curve->first()));
  };
}

/// The slip of the grid that the key "file" names, with columns x, y and slip.
std::function<double(double, double)> read_slip_grid(const Section& section, const TableReader& tables,
                                                     const Plane& plane) {
  const plane::Problem& p = plane.problem;
  const double ratio = plane.wave_speed_ratio;
  const auto grid = read_grid(TableFile(section, tables), {"slip", {.least = 0}, section.in_file(ModelUnit::slip)},
                              {p.left, p.right, p.bottom * ratio, p.top * ratio});
  return [grid, ratio](double x, double y) { return grid(x, y * ratio); };
}

void refuse_other_tables(const Document& document) {
  for (const std::string_view table : {"domain", "pulse", "loading"}) {
    const auto found = document.tables.find(table);
    if (found == document.tables.end()) continue;
    throw InputError({.file = document.file,
                      .line = found->second.line,
                      .key = std::string(table),
                      .problem = "this table is about a line, and [plane] makes the scenario one of a plane",
                      .allowed = "without [plane], or without [" + std::string(table) + "]"});
  }
  const Section chain(document, "chain");
  for (const Key* key : keys_of("chain"))
    if (chain.has(key->name) && key->name != "scale" && key->name != "spacing")
      throw chain.refuse(key->name, "does not fit [plane]", "chain.scale and chain.spacing");
  const Section output(document, "output");
  for (const std::string_view key : {"per_event", "variables", "fronts", "displacement", "dislocations"})
    if (output.has(key)) throw output.refuse(key, "does not fit [plane]", "times, every, probes and lines");
}

void read_edges(const Section& section, Plane& plane) {
  plane::Problem& p = plane.problem;
  for (const auto& [key, value] :
       {std::pair{"left", &p.left}, {"right", &p.right}, {"bottom", &p.bottom}, {"top", &p.top}}) {
    const std::optional<double> given = section.number(key);
    if (!given) throw section.refuse(key, "missing", "[plane] left, right, bottom and top");
    *value = *given;
  }
  const auto above = [&](const char* key, double bound) {
    return "> " + section.bound_as_written(key, *section.find(key), ModelUnit::position, bound);
  };
  if (p.left >= p.right) throw section.refuse("right", "not to the right of plane.left", above("right", p.left));
  if (p.bottom >= p.top) throw section.refuse("top", "not above plane.bottom", above("top", p.bottom));
  p.bottom /= plane.wave_speed_ratio;
  p.top /= plane.wave_speed_ratio;
}

/// The initial mean slip, by a formula of x and y or a table.
std::function<double(double, double)> read_slip(const Document& document, const TableReader& tables, const Plane& plane,
                                                Initial& initial) {
  const Section section(document, "initial");
  read_profile(section, true, initial);
  const double ratio = plane.wave_speed_ratio;
  if (initial.profile == ProfileKind::radial) return read_radial(section, tables, ratio);
  if (initial.profile == ProfileKind::grid) return read_slip_grid(section, tables, plane);
  const Value& text = *section.find("formula");  // [initial] formula is a stress elsewhere, and so may have its unit
  if (text.kind != Value::Kind::text && text.kind != Value::Kind::number)
    throw section.refuse("formula", "neither a text nor a number", "a formula in quotes");
  initial.formula = text.text;
  return CheckedFormula(section, "formula", text.text, {"x", "y"}, "the slip", {.least = 0}, ModelUnit::slip, ratio);
}

/// The other formulas: where the interface is held, contact and forcing.
void read_formulas(const Document& document, Scenario& scenario) {
  plane::Problem& p = scenario.plane->problem;
  const double ratio = scenario.plane->wave_speed_ratio;
  const Section plane(document, "plane"), interface(document, "interface"), forcing(document, "forcing");
  if (plane.has("fixed"))
    p.fixed =
        CheckedFormula(plane, "fixed", *plane.formula("fixed"), {"x", "y"}, "plane.fixed", {}, ModelUnit::none, ratio);
  if (interface.has("contact")) {
    scenario.contact = *interface.formula("contact");
    p.contact = read_contact(interface, {"x", "y"}, ratio);
  }
  if (forcing.has("formula")) {
    scenario.forcing = *forcing.formula("formula");
    const CheckedFormula F = read_forcing(forcing, {"x", "y", "t"}, ratio);
    p.steady_forcing = !F.has("t");
    p.forcing = F;
  }
}

void read_nucleation(const Document& document, Scenario& scenario) {
  const Section section(document, "nucleation");
  if (document.tables.count("nucleation") == 0) return;
  plane::Problem& p = scenario.plane->problem;
  const std::optional<double> radius = section.number("radius");
  if (!radius) throw section.refuse("radius", "missing", "a radius > 0");
  const double x = section.number("x").value_or(0), y = section.number("y").value_or(0);
  const double ratio = scenario.plane->wave_speed_ratio;
  if (!(x - *radius < p.right && x + *radius > p.left && y - *radius < p.top * ratio && y + *radius > p.bottom * ratio))
    throw section.refuse("radius",
                         "the patch around x = " + shortest(x) + ", y = " + shortest(y) + " is outside the plane",
                         "a patch that overlaps the plane");
  if (!scenario.initial.hold && !scenario.friction.steep_at_rest())
    throw section.refuse("radius", "nothing holds the initial state, so that the rupture begins everywhere",
                         "initial.hold = true, or a friction law with strength at rest");
  p.nucleation =
      plane::Nucleation{.x = x, .y = y / ratio, .radius = *radius, .time = section.number("time").value_or(0)};
}

/// Calls each function on a grid, so that a formula which fails does so before the run.
void try_on_plane(const Plane& plane, double end) {
  constexpr int samples = 101;
  const plane::Problem& p = plane.problem;
  for (int j = 0; j < samples; ++j)
    for (int i = 0; i < samples; ++i) {
      const double x = p.left + (p.right - p.left) * i / (samples - 1),
                   y = p.bottom + (p.top - p.bottom) * j / (samples - 1);
      for (const auto* function : {&p.slip, &p.fixed, &p.contact})
        if (*function) (*function)(x, y);
      if (!p.forcing) continue;
      p.forcing(x, y, 0);
      p.forcing(x, y, end);
    }
}

}  // namespace

bool is_plane(const Document& document) { return document.tables.count("plane") > 0; }

void read_plane(const Document& document, const TableReader& tables, Scenario& scenario) {
  refuse_other_tables(document);
  const Section section(document, "plane");
  Plane& plane = scenario.plane.emplace();
  section.read("solver", plane.on_grid);
  section.read("cells", plane.cells);
  section.read("loops", plane.loops);
  section.read("angles", plane.angles);
  section.read("wave_speed_ratio", plane.wave_speed_ratio);
  section.read("edges", plane.problem.edges);
  read_edges(section, plane);
  plane.problem.slip = read_slip(document, tables, plane, scenario.initial);
  read_formulas(document, scenario);
  plane.problem.friction = scenario.friction;
  plane.problem.hold = scenario.initial.hold;
  read_nucleation(document, scenario);
  try_on_plane(plane, scenario.end);
}

void read_plane_output(const Document& document, Plane& plane) {
  const Section section(document, "output");
  section.read("lines", plane.lines);
  constexpr const char* allowed = "an array of points, such as [[0.5, 1], [0, 2]]";
  const Value* const array = section.array("probes", allowed);
  if (!array) return;
  const plane::Problem& p = plane.problem;
  for (const Value& item : array->items) {
    if (item.kind != Value::Kind::array || item.items.size() != 2)
      throw section.refuse("probes", item, "not a point", allowed);
    const double x = section.item_in("probes", item.items[0], ModelUnit::position, {}),
                 y = section.item_in("probes", item.items[1], ModelUnit::position, {}) / plane.wave_speed_ratio;
    if (!(x >= p.left && x <= p.right && y >= p.bottom && y <= p.top))
      throw section.refuse(
          "probes", item.items[0],
          "the point " + shortest(x) + ", " + shortest(y * plane.wave_speed_ratio) + " is outside the plane",
          "points between left and right, bottom and top");
    plane.probes.push_back({x, y});
  }
}

namespace {

/// The largest initial slip, which no solver takes below 0, on the grid of the results.
double largest_slip(const plane::Problem& p, int nx, int ny) {
  double largest = 0;
  for (int j = 0; j < ny; ++j)
    for (int i = 0; i < nx; ++i)
      largest = std::fmax(largest, p.slip(p.left + (p.right - p.left) * (i + 0.5) / nx,
                                          p.bottom + (p.top - p.bottom) * (j + 0.5) / ny));
  return largest;
}

}  // namespace

void require_plane(const Scenario& s) {
  if (!s.plane)
    throw InputError(
        {.file = s.file, .key = "plane", .problem = "this table is missing", .allowed = "[plane] left = ..."});
}

void require_line(const Scenario& s) {
  if (s.plane)
    throw InputError({.file = s.file,
                      .key = "plane",
                      .problem = "the scenario is on a plane, and this command runs on a line",
                      .allowed = "slipfront plane"});
}

double scale_of_lines(const Scenario& s) {
  constexpr double enough = 20;
  constexpr int samples = 100;
  if (s.chain.scale) return *s.chain.scale;
  const double largest = largest_slip(s.plane->problem, samples, samples);
  return largest > 0 ? std::fmax(1, std::ceil(enough * 2 * std::numbers::pi / largest)) : 1;
}

std::unique_ptr<plane::Solver> plane_solver(const Scenario& s, SolverKind solver, int threads, const Ranks* ranks) {
  require_plane(s);
  const char* const slip_key = s.initial.file.empty() ? "initial.formula" : "initial.file";
  const auto make = [&]() -> std::unique_ptr<plane::Solver> {
    if (solver == SolverKind::plane && s.plane->on_grid)
      return plane::grid_solver(s.plane->problem, s.plane->cells, threads);
    if (solver == SolverKind::plane)
      return plane::loops_solver(s.plane->problem, {.loops = s.plane->loops, .angles = s.plane->angles});
    const plane::DirectOptions options{.scale = scale_of_lines(s),
                                       .spacing = s.chain.spacing.value_or(plane::DirectOptions{}.spacing),
                                       .threads = threads,
                                       .ranks = ranks};
    const double share = ranks ? ranks->share_of_machine() : 1;
    const double need = share * plane::memory_of_direct(s.plane->problem, options);
    if (need > usable_memory())
      throw InputError({.key = "scale",
                        .value = digits(options.scale),
                        .problem = "the lines need " + digits(need / 1e9, 3) + " GB of memory, this process may have " +
                                   digits(usable_memory() / 1e9, 3) + " GB",
                        .allowed = "a smaller scale"});
    return plane::direct_solver(s.plane->problem, options);
  };
  return with_keys(solver, s.file, make, slip_key);
}

namespace {

/// When a cell has ruptured, as a number and in the words that files have.
void set_rupture_rule(const Scenario& s, SolverKind solver, plane::Schedule& schedule) {
  const plane::Problem& p = s.plane->problem;
  // A state that is held settles a little at t = 0. There, and without initial slip, half a line must pass.
  const double seen = p.nucleation ? 1e-2 : 1e-3, largest = largest_slip(p, schedule.nx, schedule.ny);
  schedule.rupture_slip = seen * largest;
  const std::string when = "time at which the slip, of either sign, first exceeds ";
  schedule.rupture_rule = when + digits(seen) + " of the largest initial mean slip";
  if (solver != SolverKind::plane_direct || !(p.nucleation || !(largest > 0))) return;
  const double half_a_line = std::numbers::pi / scale_of_lines(s);
  schedule.rupture_rule =
      largest > 0 ? schedule.rupture_rule + " and that of half a line" : when + "that of half a line";
  schedule.rupture_slip = std::fmax(schedule.rupture_slip, half_a_line);
}

}  // namespace

plane::Schedule plane_schedule(const Scenario& s, SolverKind solver) {
  require_plane(s);
  constexpr double most_rows = 1000;
  const plane::Problem& p = s.plane->problem;
  const double width = p.right - p.left, cell = width / s.plane->cells;
  plane::Schedule schedule;
  schedule.times = output_times(s);
  schedule.nx = s.plane->cells;
  schedule.ny = p.rows_of_cells(schedule.nx);
  const double need = 2 * plane::memory_of_results(schedule);
  if (need > usable_memory())
    throw InputError({.file = s.file,
                      .key = "plane.cells",
                      .problem = "the results need " + digits(need / 1e9, 3) + " GB of memory, this process may have " +
                                 digits(usable_memory() / 1e9, 3) + " GB",
                      .allowed = "fewer cells or fewer output times"});
  schedule.interval = std::fmax(cell, s.end / most_rows);
  set_rupture_rule(s, solver, schedule);
  schedule.wave_speed_ratio = s.plane->wave_speed_ratio;
  schedule.lines = s.plane->lines;
  schedule.probes = s.plane->probes;
  return schedule;
}

}  // namespace slipfront::scenario
