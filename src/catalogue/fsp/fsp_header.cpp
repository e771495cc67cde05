#include <algorithm>
#include <cmath>

#include "catalogue/fsp/fsp.hpp"

namespace slipfront::catalogue::fsp {
namespace {

/// ISO (2015-09-16T22:54:32) or with slashes (09/28/2004, 2016/03/02).
bool is_date(std::string_view word) {
  if (word.find_first_not_of("0123456789/-:.TZ+") != std::string_view::npos) return false;
  if (word.front() < '0' || word.front() > '9') return false;
  return std::count(word.begin(), word.end(), '/') == 2 || std::count(word.begin(), word.end(), '-') >= 2;
}

/// `name date [reference]`; USGS files write `name date agency` instead.
void take_event(std::string_view text, Header& header) {
  const std::size_t open = text.find('[');
  const std::string_view before = text.substr(0, open);
  if (open != std::string_view::npos) {
    const std::string_view rest = text.substr(open + 1);
    header.reference = tidy(rest.substr(0, rest.find(']')));
  }
  const Words parts = words(before);
  const auto date = std::find_if(parts.begin(), parts.end(), is_date);
  std::size_t name_end = before.size();
  if (date != parts.end()) {
    header.date = *date;
    name_end = static_cast<std::size_t>(date->data() - before.data());
  } else if (parts.size() > 1 && parts.back() == "CSN") {
    name_end = before.rfind("CSN");
  }
  header.name = tidy(before.substr(0, name_end));
}

/// A quantity of the `Rupt` line. The unit is fixed by the format; another one would be misread silently.
void take_field(std::string_view text, std::string_view key, std::string_view unit, const Place& place, Field& field) {
  const auto value = value_of(text, key, place);
  if (!value) return;
  field.present = true;
  field.number = value->number;
  field.text = tidy(value->text);
  if (!value->number || value->unit.empty() || begins(value->unit, unit)) return;
  throw InputError({.file = place.file,
                    .line = place.line,
                    .key = std::string(key),
                    .value = field.text + " " + tidy(value->unit),
                    .problem = "unexpected unit",
                    .allowed = std::string(unit)});
}

/// Depth of a hypocentre in km; no earthquake is deeper than the mantle transition zone, so 999 and -99 are out.
bool is_depth(const std::optional<double>& depth) { return depth && *depth >= 0 && *depth < 900; }

}  // namespace

std::optional<double> angle_of(std::string_view text, std::string_view key, const Place& place) {
  const auto value = value_of(text, key, place);
  if (!value || !value->number || *value->number == -99 || std::fabs(*value->number) > 720) return std::nullopt;
  return value->number;
}

std::optional<double> dip_of(std::string_view text, std::string_view key, const Place& place) {
  const auto dip = angle_of(text, key, place);
  return dip && *dip > 0 && *dip <= 90 ? dip : std::nullopt;
}

bool Header::take_geometry(std::string_view label, std::string_view rest, const Place& place) {
  if (same(label, "Mech")) {
    keep(strike, angle_of(rest, "STRK", place));
    keep(dip, dip_of(rest, "DIP", place));
    keep(rake, angle_of(rest, "RAKE", place));
    if (const auto value = value_of(rest, "Htop", place); value && is_depth(value->number)) top = value->number;
  } else if (same(label, "Size")) {       // its LEN is the whole fault, and no segment may take it for its own
    constexpr double least_moment = 1e6;  // N m
    if (const auto value = value_of(rest, "Mo", place); value && value->number && *value->number > least_moment)
      moment = value->number;
  } else {
    return false;
  }
  return true;
}

bool Header::take(std::string_view text, const Place& place) {
  if (begins(text, "Coordinates are given for")) {
    positions_are_tops = text.find("top") != std::string_view::npos;
    return true;
  }
  const std::size_t colon = text.find(':');
  if (colon == std::string_view::npos) return false;
  const std::string_view label = trimmed(text.substr(0, colon));
  const std::string_view rest = text.substr(colon + 1);
  if (same(label, "Event")) {
    if (event_line > 0) {
      throw InputError({.file = place.file,
                        .line = place.line,
                        .key = "Event",
                        .value = tidy(rest),
                        .problem = "a second event in the same file",
                        .allowed = "one event a file"});
    }
    event_line = place.line;
    take_event(rest, *this);
  } else if (same(label, "EventTAG")) {
    tag = tidy(rest);
    tag_line = place.line;
  } else if (same(label, "Loc")) {
    if (const auto value = value_of(rest, "DEP", place)) depth = value->number;
  } else if (same(label, "Rupt")) {
    if (const auto value = value_of(rest, "HypZ", place)) down_dip = value->number;
    take_field(rest, "avTr", "s", place, rise_time);
    take_field(rest, "avVr", "km/s", place, rupture_velocity_km_s);
  } else if (same(label, "Invs")) {
    keep(along_strike_cells, count_of(rest, "Nx", place));
    keep(down_dip_cells, count_of(rest, "Nz", place));
    keep(segments, count_of(rest, "Nsg", place));
    keep(dx, size_of(rest, "Dx", place));
    keep(dz, size_of(rest, "Dz", place));
  } else {
    return take_geometry(label, rest, place);
  }
  return true;
}

std::string Header::citation() const {
  if (tag.empty()) return reference;
  return reference.empty() ? "EventTAG " + tag : reference + "; EventTAG " + tag;
}

std::optional<double> Header::hypocentre_depth() const {
  if (is_depth(depth)) return depth;
  return is_depth(down_dip) ? down_dip : std::nullopt;
}

}  // namespace slipfront::catalogue::fsp
