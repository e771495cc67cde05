#include <cmath>

#include "catalogue/fsp/fsp.hpp"
#include "foundation/text/digits.hpp"

namespace slipfront::catalogue::fsp {
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
