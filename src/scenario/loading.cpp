

// The table [loading] of a scenario: springs that pull a chain.

#include <cmath>
#include <optional>
#include <string_view>

#include "scenario/readers.hpp"
#include "scenario/section.hpp"

namespace slipfront::scenario {
namespace {

chain::Pulled pulled_sites(const Section& section) {
  chain::Pulled where = chain::Pulled::everywhere;
  section.read("where", where);
  return where;
}

/// Stiffness of springs that does not vary, in the unit of the model.
double uniform_stiffness(const Section& section) {
  const ModelUnit unit = unit_of_stiffness(section);
  const Value *const value = section.find("stiffness"), *const area = section.find("area");
  if (!area) return *section.number_in("stiffness", unit);
  const double square_metres = section.quantity("area", *area, medium::Dimension::area);
  if (!(square_metres > 0)) throw section.refuse("area", "not positive", "> 0");
  if (!value || value->kind != Value::Kind::text)
    throw section.refuse("area", "it needs a loading.stiffness in N/m", "leave it out, or stiffness = \"1e6 N/m\"");
  const double spring = section.quantity("stiffness", *value, medium::Dimension::spring);
  if (!(spring > 0)) throw section.refuse("stiffness", "not positive", "> 0");
  return spring / square_metres / section.si("stiffness", unit);
}

}  // namespace

ModelUnit unit_of_stiffness(const Section& section) {
  return pulled_sites(section) == chain::Pulled::everywhere ? ModelUnit::stiffness : ModelUnit::end_stiffness;
}

friction::AlongInterface read_springs(const Section& section, const AlongReader& reader, std::string_view key) {
  const bool stiffness = key == "stiffness";
  const Value* const value = section.find(key);
  if (!value && !(stiffness && section.has("area")))
    throw section.refuse(
        key, "missing",
        stiffness ? "> 0: the force of the springs over their stretch" : "a finite number: of the springs' far ends");
  if (!value || !varies(*value)) {
    const double number = stiffness ? uniform_stiffness(section) : *section.number(key);
    return {nullptr, number, number};
  }
  if (stiffness && section.has("area"))
    throw section.refuse("area", "loading.stiffness varies, as a stress over a stretch", "leave it out");
  Limits limits = section.key(key).limits;
  limits.without_least = false;  // a part of the chain may have no springs
  const ModelUnit unit = stiffness ? unit_of_stiffness(section) : ModelUnit::slip_velocity;
  friction::AlongInterface along = reader.in_range(reader.read(key, *value, unit, limits));
  if (stiffness && !(along.most > 0)) throw section.refuse(key, "is 0 everywhere", "> 0 somewhere");
  if (along.at && pulled_sites(section) != chain::Pulled::everywhere)
    throw section.refuse(key, "varies, but the springs pull one end only", "a number, or where = \"everywhere\"");
  return along;
}

void read_loading(const Document& document, const TableReader& tables, Scenario& scenario) {
  const Section section(document, "loading");
  if (!section.has("velocity") && !section.has("where") && !section.has("event_velocity") &&
      !section.has("stiffness") && !section.has("area"))
    return;
  const AlongReader reader(
      section, tables,
      interface_of(document, scenario.domain, trial_range(scenario.domain, scenario.initial.reach, {})));
  chain::Loading& loading = scenario.loading;
  const auto on_line = [](const friction::AlongInterface& along) -> std::function<double(double)> {
    if (!along.at) return nullptr;
    return [at = along.at](double x) { return at(x, 0); };
  };
  const friction::AlongInterface stiffness = read_springs(section, reader, "stiffness");
  const friction::AlongInterface velocity = read_springs(section, reader, "velocity");
  loading.stiffness = stiffness.most;
  loading.stiffness_at = on_line(stiffness);
  loading.velocity = std::fabs(velocity.least) > std::fabs(velocity.most) ? velocity.least : velocity.most;
  loading.velocity_at = on_line(velocity);
  section.read("where", loading.where);
  constexpr double times_loading = 10;
  loading.event_velocity = times_loading * std::fabs(loading.velocity);
  section.read("event_velocity", loading.event_velocity);
}

// Numbers of a table that vary along the interface: formulas, and columns of table files.

#include <algorithm>
#include <cmath>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "math/digits.hpp"
#include "scenario/document.hpp"
#include "scenario/functions.hpp"
#include "scenario/readers.hpp"
#include "scenario/section.hpp"

namespace {

/// Linear between the rows of a table.
std::function<double(double, double)> along_rows(const TableFile& file, const Column& column) {
  const Column place{"x", {.least = -farthest, .most = farthest}, file.section.in_file(ModelUnit::position)};
  const auto rows = std::make_shared<const std::vector<std::pair<double, double>>>(file.rows(place, column));
  return [rows, where = file.section.where(file.key), unit = place.unit](double x, double) {
    const double first = rows->front().first, last = rows->back().first, rounding = 1e-9 * (last - first);
    if (!(x >= first - rounding && x <= last + rounding))
      throw refused_at(
          where, "the table gives no value at x = " + digits(x * unit),
          "a table over the whole domain; it has x = " + digits(first * unit) + " to " + digits(last * unit));
    const auto next = std::upper_bound(rows->begin() + 1, rows->end() - 1, x,
                                       [](double value, const auto& row) { return value < row.first; });
    const auto& [x0, y0] = *(next - 1);
    const auto& [x1, y1] = *next;
    const double share = std::clamp((x - x0) / (x1 - x0), 0.0, 1.0);
    return y0 + share * (y1 - y0);
  };
}

TableFile file_of(const Section& section, const TableReader& tables, std::string_view key, const Value& value,
                  std::string& column) {
  std::string file;
  for (std::size_t i = 0; i < value.items.size(); ++i) {
    std::string* const text = value.names[i] == "file" ? &file : value.names[i] == "column" ? &column : nullptr;
    if (text && value.items[i].kind == Value::Kind::text) *text = value.items[i].text;
  }
  if (file.empty() || column.empty() || value.items.size() != 2)
    throw section.refuse(key, "not a column of a table",
                         "a number, a formula, or { file = \"gouge.csv\", column = \"a\" }");
  return {section, tables, key, file};
}

}  // namespace

Interface interface_of(const Document& document, const Domain& domain, const std::pair<double, double>& range) {
  if (!is_plane(document))
    return {.extent = {range.first, range.second}, .is_known = domain.left.has_value() && domain.right.has_value()};
  Interface interface;
  interface.plane = true;
  const Section plane(document, "plane");
  for (const auto& [key, value] : {std::pair{"left", &interface.extent.left},
                                   {"right", &interface.extent.right},
                                   {"bottom", &interface.extent.bottom},
                                   {"top", &interface.extent.top},
                                   {"wave_speed_ratio", &interface.ratio}}) {
    try {
      plane.read(key, *value);
    } catch (const InputError&) {  // the reader of the table reports it
    }
  }
  return interface;
}

/// The values of a key that varies.
AlongReader::At AlongReader::read(std::string_view key, const Value& value, ModelUnit unit,
                                  const Limits& limits) const {
  section_.require_units(key);
  const std::string name = section_.where(key).key;
  const double ratio = interface_.ratio;
  if (value.kind == Value::Kind::text) {
    const std::vector<std::string_view> variables =
        interface_.plane ? std::vector<std::string_view>{"x", "y"} : std::vector<std::string_view>{"x"};
    return CheckedFormula(section_, key, value.text, variables, name, limits, unit, ratio);
  }
  std::string column;
  const TableFile file = file_of(section_, tables_, key, value, column);
  const Column values{column, limits, section_.in_file(unit)};
  if (!interface_.plane) return along_rows(file, values);
  return [grid = read_grid(file, values, interface_.extent), ratio](double x, double y) { return grid(x, y * ratio); };
}

/// With its range on a grid of positions, so that a formula which fails does so before the run. A value that is the
/// same there and on a finer grid does not vary.
friction::AlongInterface AlongReader::in_range(At at) const {
  friction::AlongInterface along{std::move(at), HUGE_VAL, -HUGE_VAL};
  const Extent& e = interface_.extent;
  const auto look = [&](int columns, int rows) {
    for (int j = 0; j < rows; ++j)
      for (int i = 0; i < columns; ++i) {
        const double x = e.left + (e.right - e.left) * i / (columns - 1);
        const double y = rows > 1 ? e.bottom + (e.top - e.bottom) * j / (rows - 1) : 0;
        const double value = along.at(x, y / interface_.ratio);
        along.least = std::fmin(along.least, value);
        along.most = std::fmax(along.most, value);
      }
  };
  interface_.plane ? look(101, 101) : look(2001, 1);
  if (along.least < along.most || !interface_.is_known) return along;
  interface_.plane ? look(1001, 1001) : look(200001, 1);
  if (along.least == along.most) along.at = nullptr;
  return along;
}

}  // namespace slipfront::scenario
