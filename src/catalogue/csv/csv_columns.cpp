#include <algorithm>

#include "catalogue/csv/csv_header.hpp"
#include "catalogue/csv/csv_names.hpp"
#include "catalogue/csv/csv_title.hpp"

namespace slipfront::catalogue {
namespace {

using Role = Column::Role;

bool is_bare_error(const Title& t) {
  return t.small.size() == 1 && (deviations_of(t.small[0]) > 0 || t.small[0] == "+" || t.small[0] == "-");
}

Column physical_column(const std::string& title) {
  Column unknown{.title = title};
  unknown.looks_physical = true;
  return unknown;
}

/// A bare error belongs to the last quantity before it; so do both of a pair "+", "-". In "err (Vr)" the parentheses
/// name the quantity. If their text is neither a quantity nor a unit of the quantity before, the column is unknown.
Column bare_error(const std::string& title, const Title& t, const std::vector<Column>& before) {
  const Column* owner = before.empty() ? nullptr : &before.back();
  std::string name = owner && owner->key ? std::string(owner->key->name) : "";
  for (const std::string& group : t.groups)
    if (const Column inside = parse_column(group); inside.role == Role::quantity)
      name = std::string(inside.key->name) + " " + t.small[0];
  const bool names_another = name.find(' ') != std::string::npos;
  if (!names_another && owner && owner->role == Role::unused) return {.role = Role::unused, .title = title};
  const bool is_described = owner && owner->role == Role::provenance;
  if (name.empty() || (!names_another && is_described)) return physical_column(title);
  try {
    Column column = parse_column(names_another ? name : name + " " + title);
    column.title = title;
    return column.is_error() ? column : physical_column(title);
  } catch (const InputError&) {
    return physical_column(title);  // the unit is that of something else
  }
}

/// Makes a column one that is not used; `looks_physical` if its numbers are lost.
void drop(Column& column, bool looks_physical) {
  column = {.role = looks_physical ? Role::unknown : Role::unused, .title = column.title};
  column.looks_physical = looks_physical;
}

/// Whether both give the same number of the same quantity.
bool collide(const Column& a, const Column& b) {
  return a.key && a.key == b.key && a.role == b.role && (a.is_quantity() || a.is_error());
}

/// The mean counts if the other column is the largest value. The first of two auxiliary columns counts.
void settle(Column& first, Column& second) {
  if (first.title == second.title)
    throw InputError({.key = second.title, .problem = "column given twice", .allowed = "each column once"});
  if (first.is_largest != second.is_largest) return drop(first.is_largest ? first : second, false);
  if (is_auxiliary(*second.key)) return drop(second, true);
  throw InputError({.key = second.title,
                    .problem = "a second column of " + std::string(second.key->name) + " besides '" + first.title + "'",
                    .allowed = "one; --columns map.toml can ignore the other"});
}

/// A title such as "Vr +- 1 sd (km/s)" names the value too, unless another column does. Other errors without a value
/// are not understood.
void settle_errors_without_value(std::vector<Column>& columns) {
  for (Column& column : columns) {
    const bool has_value = std::any_of(columns.begin(), columns.end(),
                                       [&](const Column& c) { return c.is_quantity() && c.key == column.key; });
    if (!column.is_error() || has_value) continue;
    const Title t = divide_title(column.title);
    const bool has_sign = t.small.size() > 1 && std::any_of(t.small.begin() + 1, t.small.end(), [](const auto& word) {
                            return word == "+-" || word == "+/-" || word == "\xC2\xB1";
                          });
    if (has_sign)
      column.role = Role::quantity;
    else
      drop(column, true);
  }
}

}  // namespace

bool is_auxiliary(const Key& key) {
  return key.name == "moment" || key.name == "moment_magnitude" || key.name == "rupture_length" ||
         key.name == "rupture_width" || key.name == "rupture_area";
}

Column parse_column(const std::string& title, const std::vector<Column>& before) {
  const Title t = divide_title(title);
  return is_bare_error(t) ? bare_error(title, t, before) : parse_column(title);
}

void settle_columns(std::vector<Column>& columns) {
  settle_errors_without_value(columns);
  for (std::size_t i = 0; i < columns.size(); ++i)
    for (std::size_t j = 0; j < i; ++j)
      if (collide(columns[i], columns[j])) settle(columns[j], columns[i]);
}

}  // namespace slipfront::catalogue
