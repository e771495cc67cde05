#include "scenario/plane/plane.hpp"

#include <cmath>
#include <functional>
#include <optional>
#include <utility>
#include <vector>

#include "foundation/text/digits.hpp"
#include "scenario/formula/formula.hpp"
#include "scenario/plane/grid.hpp"
#include "scenario/plane/radial.hpp"
#include "scenario/settings.hpp"

namespace slipfront::scenario {
namespace {

/// A formula of x, y and t with its file, line and key, and with the ranges that its values must keep.
struct PlaneFormula {
  Formula formula;
  Complaint where;
  std::string name;                       ///< "the slip"
  std::string allowed;                    ///< "a finite number >= 0"
  double least = -HUGE_VAL;               ///< smallest value
  bool without_least = false;             ///< the value must be larger than that
  double length = 1, time = 1, unit = 1;  ///< units of the model in those of the formula
  double ratio = 1;                       ///< y of the formula over y of the problem

  double operator()(double x, double y, double t = 0) const {
    const double value = formula(x * length, y * ratio * length, t * time) / unit;
    if (std::isfinite(value) && (without_least ? value > least : value >= least)) return value;
    Complaint complaint = where;
    complaint.problem = name + " is " + shortest(value) + " at x = " + shortest(x) + ", y = " + shortest(y * ratio);
    complaint.allowed = allowed;
    throw InputError(complaint);
  }
};

/// Reads the formula of a key. \throws InputError that names the key.
PlaneFormula read_formula(const Section& section, std::string_view key, const std::string& text,
                          const std::vector<std::string_view>& variables, std::string name, std::string allowed) {
  try {
    return {.formula = Formula(text, variables),
            .where = section.where(key),
            .name = std::move(name),
            .allowed = std::move(allowed)};
  } catch (const InputError& error) {
    throw section.refuse(key, error.complaint().problem, error.complaint().allowed);
  }
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
  for (const std::string_view key : {"per_event", "variables", "fronts"})
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
  if (!(p.left < p.right)) throw section.refuse("right", "not to the right of plane.left", "> " + shortest(p.left));
  if (!(p.bottom < p.top)) throw section.refuse("top", "not above plane.bottom", "> " + shortest(p.bottom));
  p.bottom /= plane.wave_speed_ratio;
  p.top /= plane.wave_speed_ratio;
}

/// The initial mean slip, by a formula of x and y or a table of r and slip.
std::function<double(double, double)> read_slip(const Document& document, const TableReader& tables, const Plane& plane,
                                                Initial& initial) {
  const Section section(document, "initial");
  for (const std::string_view key : {"stress_left", "stress_right", "width"})
    if (section.has(key)) throw section.refuse(key, "does not fit [plane]", "the initial slip, by formula or file");
  const std::string word = section.text("profile").value_or("");
  if (word != "formula" && word != "radial" && word != "grid")
    throw section.refuse("profile", word.empty() ? "missing" : "does not fit [plane]", "formula, radial, grid");
  initial.profile = word == "formula"  ? ProfileKind::formula
                    : word == "radial" ? ProfileKind::radial
                                       : ProfileKind::grid;
  initial.hold = section.truth("hold").value_or(false);
  const std::string_view wanted = word == "formula" ? "formula" : "file",
                         other = word == "formula" ? "file" : "formula";
  if (!section.has(wanted)) throw section.refuse(wanted, "missing", "profile = \"" + word + "\" needs it");
  if (section.has(other)) throw section.refuse(other, "does not fit profile = \"" + word + '"', "leave it out");
  if (word != "formula") {
    initial.file = *section.text("file");
    return word == "radial" ? read_radial(section, tables, plane.wave_speed_ratio) : read_grid(section, tables, plane);
  }
  const Value& text = *section.find("formula");  // [initial] formula is a stress elsewhere, and so may have its unit
  if (text.kind != Value::Kind::text && text.kind != Value::Kind::number)
    throw section.refuse("formula", "neither a text nor a number", "a formula in quotes");
  initial.formula = text.text;
  PlaneFormula slip = read_formula(section, "formula", initial.formula, {"x", "y"}, "the slip", "a finite number >= 0");
  slip.least = 0;
  slip.length = section.in_file(ModelUnit::position);
  slip.unit = section.in_file(ModelUnit::slip);
  slip.ratio = plane.wave_speed_ratio;
  return slip;
}

/// The other formulas: where the interface is held, contact, forcing, and the coefficient of viscous friction.
void read_formulas(const Document& document, const std::string& coefficient, Scenario& scenario) {
  Plane& plane = *scenario.plane;
  const double ratio = plane.wave_speed_ratio;
  if (const Section section(document, "plane"); section.has("fixed")) {
    PlaneFormula fixed =
        read_formula(section, "fixed", *section.formula("fixed"), {"x", "y"}, "plane.fixed", "a finite number");
    fixed.length = section.in_file(ModelUnit::position);
    fixed.ratio = ratio;
    plane.problem.fixed = fixed;
  }
  if (const Section section(document, "interface"); section.has("contact")) {
    scenario.contact = *section.formula("contact");
    PlaneFormula contact =
        read_formula(section, "contact", scenario.contact, {"x", "y"}, "the contact ratio", "a finite number > 0");
    contact.least = 0;
    contact.without_least = true;
    contact.length = section.in_file(ModelUnit::position);
    contact.ratio = ratio;
    plane.problem.contact = contact;
  }
  if (const Section section(document, "forcing"); section.has("formula")) {
    scenario.forcing = *section.formula("formula");
    PlaneFormula forcing =
        read_formula(section, "formula", scenario.forcing, {"x", "y", "t"}, "the forcing", "a finite number");
    forcing.length = section.in_file(ModelUnit::position);
    forcing.time = section.in_file(ModelUnit::time);
    forcing.unit = section.in_file(ModelUnit::force);
    forcing.ratio = ratio;
    plane.problem.forcing = forcing;
  }
  if (coefficient.empty()) return;
  const Section friction(document, "friction");
  PlaneFormula share =
      read_formula(friction, "coefficient", coefficient, {"x", "y"}, "the coefficient", "a finite number >= 0");
  share.length = friction.in_file(ModelUnit::position);
  share.least = 0;
  share.ratio = ratio;
  scenario.friction = scenario.friction.with("coefficient", share);
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
void try_out(const Plane& plane, double end) {
  constexpr int samples = 101;
  const plane::Problem& p = plane.problem;
  for (int j = 0; j < samples; ++j)
    for (int i = 0; i < samples; ++i) {
      const double x = p.left + (p.right - p.left) * i / (samples - 1),
                   y = p.bottom + (p.top - p.bottom) * j / (samples - 1);
      p.friction.factor(x, y);
      for (const auto* function : {&p.slip, &p.fixed, &p.contact})
        if (*function) (*function)(x, y);
      if (!p.forcing) continue;
      p.forcing(x, y, 0);
      p.forcing(x, y, end);
    }
}

}  // namespace

bool is_plane(const Document& document) { return document.tables.count("plane") > 0; }

std::string take_coefficient(Document& document) {
  const auto friction = document.tables.find("friction");
  if (friction == document.tables.end()) return {};
  auto& values = friction->second.values;
  const auto found = values.find("coefficient");
  if (found == values.end() || found->second.kind != Value::Kind::text) return {};
  const auto law = values.find("law");
  if (law != values.end() && law->second.text != "viscous" && is_quantity(found->second.text)) return {};
  const InputError refusal =
      Section(document, "friction")
          .refuse("coefficient", "a formula, which only viscous friction may have", "a number, or law = \"viscous\"");
  std::string formula = std::exchange(found->second.text, std::string("1"));
  found->second.kind = Value::Kind::number;
  found->second.number = 1;
  found->second.stands_for_formula = true;
  if (law == values.end() || law->second.text != "viscous") throw refusal;
  return formula;
}

void read_plane(const Document& document, const TableReader& tables, const std::string& coefficient,
                Scenario& scenario) {
  refuse_other_tables(document);
  const Section section(document, "plane");
  Plane& plane = scenario.plane.emplace();
  plane.on_grid = section.choice<bool>("solver", {{"loops", false}, {"grid", true}}).value_or(false);
  plane.cells = section.whole_number("cells").value_or(plane.cells);
  plane.loops = section.whole_number("loops").value_or(plane.loops);
  plane.angles = section.whole_number("angles").value_or(plane.angles);
  plane.wave_speed_ratio = section.number("wave_speed_ratio").value_or(plane.wave_speed_ratio);
  read_edges(section, plane);
  plane.problem.edges = section
                            .choice<plane::Edges>("edges", {{"free", plane::Edges::free},
                                                            {"fixed", plane::Edges::fixed},
                                                            {"absorbing", plane::Edges::absorbing}})
                            .value_or(plane::Edges::free);
  plane.problem.slip = read_slip(document, tables, plane, scenario.initial);
  read_formulas(document, coefficient, scenario);
  plane.problem.friction = scenario.friction;
  plane.problem.hold = scenario.initial.hold;
  read_nucleation(document, scenario);
  try_out(plane, scenario.end);
}

void read_plane_output(const Document& document, Plane& plane) {
  const Section section(document, "output");
  plane.lines = section.truth("lines").value_or(false);
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

}  // namespace slipfront::scenario
