#include <algorithm>
#include <cmath>

#include "events/catalogue/fsp/fsp.hpp"
#include "math/digits.hpp"

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

namespace {

constexpr double least_s_velocity = 0.1;  // km/s

/// Column of a velocity, written `P-VEL` or `P_VEL`.
std::optional<std::size_t> velocity_column(const Words& names, std::string_view wave) {
  for (const std::string_view joint : {"-VEL", "_VEL"}) {
    if (const auto column = index_of(names, std::string(wave) + std::string(joint))) return column;
  }
  return std::nullopt;
}

double finite(std::string_view word, double value, const Place& place) {
  if (std::isfinite(value)) return value;
  throw InputError({.file = place.file,
                    .line = place.line,
                    .key = "velocity table",
                    .value = std::string(word),
                    .problem = "out of range",
                    .allowed = "a finite number"});
}

}  // namespace

void VelocityTable::take(std::string_view text, const Place& place) {
  if (const auto count = count_of(text, "layers", place)) stated_layers_ = count;
  const Words row = words(text);
  const auto depth = index_of(row, "DEPTH");
  const auto p = velocity_column(row, "P");
  const auto s = velocity_column(row, "S");
  const auto density = index_of(row, "DENS");
  if (depth && p && s && density) {
    columns_ = Columns{*depth, *p, *s, *density};
  } else if (text.find("10**10 N/m^2") != std::string_view::npos) {
    modulus_follows_ = true;
  } else if (columns_) {
    take_layer(row, place);
  } else if (const auto value = row.empty() ? std::nullopt : number(row[0]);
             value && !std::isnan(*value) && modulus_follows_) {
    modulus_ = finite(row[0], *value, place);
    modulus_follows_ = false;
  }
}

void VelocityTable::take_layer(const Words& row, const Place& place) {
  const auto cell = [&](std::size_t column) -> std::optional<double> {
    const auto value = column < row.size() ? number(row[column]) : std::nullopt;
    return value && !is_placeholder(*value) ? std::optional(finite(row[column], *value, place)) : std::nullopt;
  };
  const auto depth = cell(columns_->depth);
  const auto p = cell(columns_->p);
  const auto s = cell(columns_->s);
  const auto density = cell(columns_->density);
  if (depth && p && s && density) layers_.push_back({*depth, *p, *s, *density});
}

/// Empty if layers can be looked up by depth.
std::string VelocityTable::why_unusable() const {
  if (stated_layers_ && layers_.size() < *stated_layers_) {
    return "has " + std::to_string(layers_.size()) + " of the " + std::to_string(*stated_layers_) +
           " layers it announces";
  }
  for (std::size_t k = 1; k < layers_.size(); ++k) {
    if (layers_[k].depth < layers_[k - 1].depth) return "has depths that do not increase";
  }
  return {};
}

/// Depths are tops of layers if the first is the surface; a table that begins deeper lists bottoms.
std::size_t VelocityTable::layer_at(double depth) const {
  const bool tops = layers_.front().depth <= 0;
  std::size_t at = 0;
  while (at + 1 < layers_.size() && (tops ? layers_[at + 1].depth <= depth : layers_[at].depth < depth)) ++at;
  return at;
}

/// USGS tables give water 0.01 km/s instead of 0.
bool VelocityTable::is_water(const Layer& layer) { return layer.s >= 0 && layer.s < least_s_velocity; }

bool VelocityTable::is_water_at(double depth) const {
  return !layers_.empty() && why_unusable().empty() && is_water(layers_[layer_at(depth)]);
}

bool VelocityTable::is_physical(const Layer& layer) {
  // vp > sqrt(2) vs is a Poisson ratio above 0; with vs and vp bounded it stays below 0.5 in floating point too.
  return layer.s >= least_s_velocity && layer.p > 1.42 * layer.s && layer.p < 20 && layer.density >= 0.9 &&
         layer.density <= 8;
}

std::vector<RockLayer> VelocityTable::rock() const {
  std::vector<RockLayer> out;
  if (layers_.empty() || !why_unusable().empty()) return out;
  constexpr double si = 1000;  // km, km/s and g/cm^3
  const bool tops = layers_.front().depth <= 0;
  for (std::size_t k = 0; k < layers_.size(); ++k) {
    const Layer& layer = layers_[k];
    if (is_water(layer)) continue;
    if (!is_physical(layer)) return {};
    const double top = tops ? layer.depth : k == 0 ? 0 : layers_[k - 1].depth;
    out.push_back({si * top, si * layer.p, si * layer.s, si * layer.density});
  }
  return out;
}

void VelocityTable::fill(std::optional<double> depth, Observation& out) const {
  const auto warn = [&](const std::string& text) { out.warnings.push_back(text + ": elastic constants not given"); };
  if (layers_.empty()) {
    constexpr double pa = 1e10;
    if (modulus_ && *modulus_ > 0 && *modulus_ < 99) {
      out.shear_modulus = *modulus_ * pa;
    } else {
      warn("no usable velocity table");
    }
    return;
  }
  if (const std::string why = why_unusable(); !why.empty()) return warn("the velocity table " + why);
  if (!depth) return warn("the depth of the hypocentre is not given");

  std::size_t at = layer_at(*depth);
  if (layers_.front().depth > 0) out.warnings.push_back("the velocity table begins below 0 km: depths read as bottoms");
  const std::size_t found = at;
  while (at + 1 < layers_.size() && is_water(layers_[at])) ++at;
  if (at != found) out.warnings.push_back("the hypocentre is in the water layer: elastic constants of the layer below");

  const Layer& layer = layers_[at];
  if (!is_physical(layer)) {
    return warn("unphysical layer in the velocity table (vp = " + shortest(layer.p) +
                " km/s, vs = " + shortest(layer.s) + " km/s, density = " + shortest(layer.density) + " g/cm^3)");
  }
  const double p = 1000 * layer.p, s = 1000 * layer.s, density = 1000 * layer.density;
  out.p_wave_speed = p;
  out.s_wave_speed = s;
  out.density = density;
  out.shear_modulus = density * s * s;
  out.poisson_ratio = (p * p - 2 * s * s) / (2 * (p * p - s * s));
}

}  // namespace slipfront::catalogue::fsp
