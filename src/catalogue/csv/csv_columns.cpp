#include <algorithm>

#include "catalogue/csv/csv_header.hpp"
#include "catalogue/csv/csv_names.hpp"
#include "catalogue/csv/csv_title.hpp"

namespace slipfront::catalogue {
namespace {

using Role = Column::Role;

bool is_bare_error(const std::string& title) {
  const Title t = divide_title(title);
  return t.small.size() == 1 && (deviations_of(t.small[0]) > 0 || t.small[0] == "+" || t.small[0] == "-");
}

/// A bare error belongs to the last quantity before it; so do both of a pair "+", "-".
Column bare_error(const std::string& title, const std::vector<Column>& before) {
  Column column = parse_column("slip " + title);
  column.title = title;
  const Column* owner = before.empty() ? nullptr : &before.back();
  if (owner && owner->role == Role::unused) return {.role = Role::unused, .title = title};
  if (!owner || !owner->key || owner->role == Role::provenance) {
    Column unknown{.title = title};
    unknown.looks_physical = true;
    return unknown;
  }
  column.key = owner->key;
  return column;
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

}  // namespace

bool is_auxiliary(const Key& key) {
  return key.name == "moment" || key.name == "moment_magnitude" || key.name == "rupture_length" ||
         key.name == "rupture_width" || key.name == "rupture_area";
}

Column parse_column(const std::string& title, const std::vector<Column>& before) {
  return is_bare_error(title) ? bare_error(title, before) : parse_column(title);
}

void settle_columns(std::vector<Column>& columns) {
  for (std::size_t i = 0; i < columns.size(); ++i)
    for (std::size_t j = 0; j < i; ++j)
      if (collide(columns[i], columns[j])) settle(columns[j], columns[i]);
}

}  // namespace slipfront::catalogue
