#include <algorithm>
#include <array>
#include <cmath>
#include <nlohmann/json.hpp>

#include "events/catalogue/fault_model.hpp"
#include "events/catalogue/subfaults/subfaults.hpp"
#include "text/characters.hpp"

/// \file
/// The subfaults that the USGS publishes as polygons with properties (FFM.geojson).

namespace slipfront::catalogue::subfaults {
namespace {

using Value = nlohmann::json;

constexpr double deepest_in_km = 800;  // larger numbers are metres

struct Corner {
  double longitude, latitude, depth;
};

[[noreturn]] void refuse_feature(const std::string& file, std::size_t number, const std::string& problem,
                                 const std::string& allowed) {
  throw InputError(
      {.file = file, .line = 1, .key = "feature " + std::to_string(number), .problem = problem, .allowed = allowed});
}

std::array<Corner, 4> corners_of(const Value& feature, const std::string& file, std::size_t number) try {
  const Value& ring = feature.at("geometry").at("coordinates").at(0);
  std::array<Corner, 4> corners{};
  for (std::size_t i = 0; i < 4; ++i)
    corners[i] = {ring.at(i).at(0).get<double>(), ring.at(i).at(1).get<double>(), ring.at(i).at(2).get<double>()};
  return corners;
} catch (const Value::exception&) {
  refuse_feature(file, number, "no polygon of four corners with depths",
                 "a Polygon with longitude, latitude and depth");
}

/// Position, size and direction from the corners. The two upper ones give the strike, so that the plane dips to its
/// right.
void place(Row& row, std::array<Corner, 4> c) {
  for (int turn = 0; turn < 3 && c[0].depth + c[1].depth > c[2].depth + c[3].depth + 1e-6; ++turn)
    std::rotate(c.begin(), c.begin() + 1, c.end());
  if (c[1].depth + c[2].depth < c[0].depth + c[1].depth - 1e-6) std::rotate(c.begin(), c.begin() + 1, c.end());
  const double east = m_per_degree * std::cos(radians(c[0].latitude));
  const auto x = [&](int i) { return east * std::remainder(c[std::size_t(i)].longitude - c[0].longitude, 360); };
  const auto y = [&](int i) { return m_per_degree * (c[std::size_t(i)].latitude - c[0].latitude); };
  const double dx = x(2) - x(1), dy = y(2) - y(1), dz = c[2].depth - c[1].depth;
  double along_x = x(1), along_y = y(1);
  if (dx * along_y - dy * along_x < 0) along_x = -along_x, along_y = -along_y;
  row.length = std::hypot(along_x, along_y, c[1].depth - c[0].depth);
  row.width = std::hypot(dx, dy, dz);
  row.longitude = c[0].longitude + (x(1) + x(2) + x(3)) / 4 / east;
  row.latitude = c[0].latitude + (y(1) + y(2) + y(3)) / 4 / m_per_degree;
  row.depth = (c[0].depth + c[1].depth + c[2].depth + c[3].depth) / 4;
  if (std::isnan(row.strike)) row.strike = std::atan2(along_x, along_y) / radians(1);
  if (std::isnan(row.dip)) row.dip = std::atan2(std::fabs(dz), std::hypot(dx, dy)) / radians(1);
}

double property(const Value& properties, std::initializer_list<const char*> names) {
  for (const char* name : names)
    if (const auto at = properties.find(name); at != properties.end() && at->is_number()) return at->get<double>();
  return none;
}

/// Depth, longitude and latitude of the hypocentre, if the file has metadata.
void read_metadata(const Value& document, Table& table) {
  const auto at = document.find("metadata");
  if (at == document.end() || !at->is_object()) return;
  table.longitude = property(*at, {"longitude", "hypocenter_x"});
  table.latitude = property(*at, {"latitude", "hypocenter_y"});
  table.depth = 1000 * property(*at, {"depth", "hypocenter_z"});
  for (const char* name : {"title", "location", "eventsourcecode"})
    if (const auto text = at->find(name); table.name.empty() && text != at->end() && text->is_string())
      table.name = text->get<std::string>();
}

Table read_geojson(std::string_view text, const std::string& file) {
  Table table{.file = file, .format = "GeoJSON of subfaults"};
  const Value document = Value::parse(text.begin(), text.end(), nullptr, false);
  const auto features = document.is_object() ? document.find("features") : document.end();
  if (!document.is_object() || features == document.end() || !features->is_array())
    throw InputError({.file = file, .line = 1, .problem = "not a JSON object", .allowed = "GeoJSON with features"});
  read_metadata(document, table);
  std::vector<std::array<Corner, 4>> outlines;
  double deepest = 0;
  for (const Value& feature : *features) {
    const std::size_t number = outlines.size() + 1;
    outlines.push_back(corners_of(feature, file, number));
    for (const Corner& c : outlines.back()) deepest = std::fmax(deepest, std::fabs(c.depth));
    const auto p = feature.find("properties");
    if (p == feature.end() || !p->is_object()) refuse_feature(file, number, "no properties", "properties with slip");
    Row row{.line = 1};
    row.slip = property(*p, {"slip", "slip_m"});
    row.rake = property(*p, {"rake"});
    row.strike = property(*p, {"strike"}), row.dip = property(*p, {"dip"});
    row.segment = property(*p, {"segment"});
    row.rupture_time = property(*p, {"trup", "t_rup", "rupture_time"});
    row.rise_time = property(*p, {"rise", "t_ris", "t_rise", "rise_time"});
    row.fall_time = property(*p, {"fall", "t_fal", "t_fall"});
    row.moment = property(*p, {"sf_moment", "moment", "mo"});
    table.rows.push_back(row);
  }
  const double unit = deepest > deepest_in_km ? 1 : 1000;
  table.notes.push_back(unit == 1 ? "depths of the corners are in m" : "depths of the corners are in km");
  for (std::size_t i = 0; i < outlines.size(); ++i) {
    for (Corner& c : outlines[i]) c.depth = unit * std::fabs(c.depth);
    place(table.rows[i], outlines[i]);
  }
  return table;
}

bool is_geojson_of_subfaults(std::string_view text) {
  const std::string_view start = text.substr(0, 20000);
  const auto has_key = [&](std::string_view key) { return start.find(key) != std::string_view::npos; };
  return trimmed(start).starts_with('{') && has_key("\"features\"") && has_key("\"Polygon\"") && has_key("\"slip") &&
         !has_key("\"mag\"");
}

}  // namespace

const FaultFormat geojson_format{is_geojson_of_subfaults, read_geojson};

}  // namespace slipfront::catalogue::subfaults
