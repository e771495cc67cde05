#include "catalogue/csv/csv_subfaults.hpp"

#include <algorithm>
#include <set>

#include "catalogue/csv/csv_title.hpp"

namespace slipfront::catalogue {
namespace {

using Role = Column::Role;

/// The first words of the titles, in small letters.
std::set<std::string> first_words(const Layout& layout) {
  std::set<std::string> all;
  for (const std::string& title : layout.titles) {
    const Title t = divide_title(title);
    if (!t.small.empty()) all.insert(t.small.front());
  }
  return all;
}

bool any_of(const std::set<std::string>& words, std::initializer_list<const char*> wanted) {
  return std::any_of(wanted.begin(), wanted.end(), [&](const char* word) { return words.count(word) > 0; });
}

bool describes_events(const Layout& layout) {
  return std::any_of(layout.columns.begin(), layout.columns.end(), [](const Column& c) {
    if (c.role == Role::name || c.role == Role::date || c.role == Role::year || c.role == Role::kind) return true;
    return c.key && (c.key->name == "duration" || c.key->name == "rupture_velocity" || c.key->name == "stress_drop" ||
                     c.key->name == "moment_magnitude" || c.key->name == "slip_velocity");
  });
}

}  // namespace

void refuse_subfaults(const Layout& layout) {
  const auto words = first_words(layout);
  const bool has_slip = std::any_of(layout.columns.begin(), layout.columns.end(),
                                    [](const Column& c) { return c.key && c.key->name == "slip"; }) ||
                        any_of(words, {"slip", "ss", "ds", "strikeslip", "dipslip"});
  const bool has_position =
      (any_of(words, {"lat", "latitude"}) && any_of(words, {"lon", "long", "longitude", "lng"})) ||
      (any_of(words, {"x", "x==ew", "x==ns", "easting", "east"}) &&
       any_of(words, {"y", "y==ns", "y==ew", "northing", "north"}));
  const bool has_depth = any_of(words, {"depth", "dep", "z", "top"});
  const bool is_patch = any_of(words, {"rake", "strike", "dip", "trup", "rise", "segment", "subfault", "patch",
                                       "length", "rupture", "tini", "ss", "ds"});
  if (!has_slip || !has_position || !has_depth || !is_patch || describes_events(layout)) return;
  throw InputError({.line = layout.header_line,
                    .problem = "a table of subfaults (slip at positions and depths), not of events",
                    .allowed = "one event a row; a finite-fault model is read from its .fsp file"});
}

}  // namespace slipfront::catalogue
