#include "runs/record/faults/fault_files.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <functional>
#include <initializer_list>
#include <numbers>
#include <string_view>
#include <utility>
#include <vector>

#include "events/finite_fault/source/source.hpp"
#include "math/digits.hpp"
#include "runs/record/netcdf/netcdf.hpp"
#include "system/files/whole_file.hpp"
#include "text/characters.hpp"

namespace slipfront::record {
namespace {

using finite_fault::FiniteSource;
using finite_fault::SourcePoint;
using finite_fault::SourceSegment;

struct PointVariable {
  const char *name, *long_name, *units;
  std::function<double(const SourcePoint&)> get;
};
const std::vector<PointVariable>& point_variables() {
  static const std::vector<PointVariable> all = {
      {"longitude", "longitude of the centre of the subfault", "degrees_east",
       [](const SourcePoint& p) { return p.longitude; }},
      {"latitude", "latitude of the centre of the subfault", "degrees_north",
       [](const SourcePoint& p) { return p.latitude; }},
      {"depth", "depth of the centre of the subfault", "m", [](const SourcePoint& p) { return p.depth; }},
      {"slip", "final slip", "m", [](const SourcePoint& p) { return p.slip; }},
      {"rake", "direction of slip from strike, counterclockwise on the fault plane seen from the hanging wall",
       "degree", [](const SourcePoint& p) { return p.rake; }},
      {"rupture_time", "time when slip begins", "s", [](const SourcePoint& p) { return p.rupture_time; }},
      {"rise_time", "time for which the subfault slips", "s", [](const SourcePoint& p) { return p.rise_time; }},
      {"rupture_velocity", "rupture velocity, 1 over the gradient of the rupture times of the file", "m s-1",
       [](const SourcePoint& p) { return p.rupture_velocity.value_or(NAN); }},
      {"s_wave_speed", "speed of S waves", "m s-1", [](const SourcePoint& p) { return p.s_wave_speed; }},
      {"density", "density of the rock", "kg m-3", [](const SourcePoint& p) { return p.density; }},
      {"shear_modulus", "shear modulus of the rock", "Pa", [](const SourcePoint& p) { return p.shear_modulus(); }},
  };
  return all;
}

struct SegmentVariable {
  const char *name, *long_name, *units;
  double (*get)(const SourceSegment&);
};
constexpr SegmentVariable segment_variables[] = {
    {"strike", "strike, clockwise from north", "degree", [](const SourceSegment& s) { return s.strike; }},
    {"dip", "dip from the horizontal, to the right of strike", "degree", [](const SourceSegment& s) { return s.dip; }},
    {"cell_length", "length of a subfault along strike", "m", [](const SourceSegment& s) { return s.cell_length; }},
    {"cell_width", "width of a subfault down dip", "m", [](const SourceSegment& s) { return s.cell_width; }},
    {"stress_drop_shear_modulus", "shear modulus that gives stress_drop", "Pa",
     [](const SourceSegment& s) { return shear_modulus_of(s); }},
};

/// Size of the grid that holds every segment.
struct Shape {
  std::size_t segments, down_dip = 0, along_strike = 0;
  explicit Shape(const FiniteSource& source) : segments(source.segments.size()) {
    for (const SourceSegment& s : source.segments) {
      down_dip = std::max(down_dip, s.down_dip);
      along_strike = std::max(along_strike, s.along_strike);
    }
  }
};

/// Values of all subfaults on the padded grid. `value` gets a segment and the index of a point in it.
template <class Value>
std::vector<double> on_grid(const FiniteSource& source, const Value& value) {
  const Shape shape(source);
  std::vector<double> out(shape.segments * shape.down_dip * shape.along_strike, NAN);
  for (std::size_t k = 0; k < shape.segments; ++k) {
    const SourceSegment& s = source.segments[k];
    for (std::size_t i = 0; i < s.points.size(); ++i) {
      const std::size_t row = i / s.along_strike, column = i % s.along_strike;
      out[(k * shape.down_dip + row) * shape.along_strike + column] = value(k, i);
    }
  }
  return out;
}

DatasetVariable on_subfaults(const char* name, const char* long_name, const char* units, std::vector<double> values) {
  return {.name = name,
          .dimensions = {"segment", "down_dip", "along_strike"},
          .values = std::move(values),
          .attributes = {{"long_name", long_name}, {"units", units}, {"_FillValue", NAN}}};
}

void add_points(Dataset& file, const FiniteSource& source) {
  for (const PointVariable& v : point_variables()) {
    DatasetVariable variable = on_subfaults(
        v.name, v.long_name, v.units,
        on_grid(source, [&](std::size_t k, std::size_t i) { return v.get(source.segments[k].points[i]); }));
    const std::string name = v.name;
    if (name == "longitude" || name == "latitude" || name == "depth")
      variable.attributes.emplace_back("standard_name", name);
    else
      variable.attributes.emplace_back("coordinates", "longitude latitude depth");
    if (name == "depth") variable.attributes.emplace_back("positive", "down");
    file.variables.push_back(std::move(variable));
  }
}

void add_stress_drop(Dataset& file, const FiniteSource& source) {
  std::vector<std::vector<double>> drops;
  for (const SourceSegment& s : source.segments) drops.push_back(static_stress_drop(s, source.poisson_ratio));
  DatasetVariable variable =
      on_subfaults("stress_drop", "static stress drop in the direction of rake, from the slip", "Pa",
                   on_grid(source, [&](std::size_t k, std::size_t i) { return drops[k][i]; }));
  variable.attributes.emplace_back("coordinates", "longitude latitude depth");
  variable.attributes.emplace_back(
      "comment",
      "Stress before minus stress after, at the centre of the subfault. Each segment is a plane in a homogeneous full "
      "space, and every subfault slips uniformly. Free surface, layers and other segments are left out.");
  variable.attributes.emplace_back("references", "Andrews (1980), J. Geophys. Res. 85, 3867-3877");
  file.variables.push_back(std::move(variable));
}

void add_segments(Dataset& file, const FiniteSource& source) {
  std::vector<std::int64_t> numbers;
  for (std::size_t k = 0; k < source.segments.size(); ++k) numbers.push_back(static_cast<std::int64_t>(k) + 1);
  file.variables.push_back({.name = "segment",
                            .dimensions = {"segment"},
                            .values = numbers,
                            .attributes = {{"long_name", "number of the segment in the file"}, {"units", "1"}}});
  for (const SegmentVariable& v : segment_variables) {
    std::vector<double> values;
    for (const SourceSegment& s : source.segments) values.push_back(v.get(s));
    file.variables.push_back({.name = v.name,
                              .dimensions = {"segment"},
                              .values = values,
                              .attributes = {{"long_name", v.long_name}, {"units", v.units}}});
  }
}

}  // namespace

void write_fault_grid(const std::string& path, const FiniteSource& source, const std::string& version,
                      const std::string& history) {
  const Shape shape(source);
  Dataset file;
  file.dimensions = {{"segment", shape.segments}, {"down_dip", shape.down_dip}, {"along_strike", shape.along_strike}};
  std::string comment = "down_dip counts from the upper edge, and along_strike in the direction of strike.";
  for (const std::string& note : source.notes) comment += "\n" + note;
  const auto text = [](const std::string& raw) { return clean_text(raw, netcdf::longest_text); };
  file.attributes = {{"Conventions", "CF-1.10"},
                     {"title", text("Finite-fault source: " + source.name)},
                     {"source", "slipfront " + version},
                     {"history", text(history)},
                     {"comment", text(comment)},
                     {"moment_n_m", source.moment},
                     {"poisson_ratio", source.poisson_ratio}};
  add_segments(file, source);
  add_points(file, source);
  add_stress_drop(file, source);
  write_dataset(path, file);
}

namespace {

using finite_fault::FiniteSource;
using finite_fault::SourcePoint;
using finite_fault::SourceSegment;

constexpr double cm = 100, cm2 = 1e4, km = 1e-3, g_per_cm3 = 1e-3;  // factors from SI units
constexpr int precision = 9;                                        // sums of slip rates keep the moment to 1e-8
constexpr int precision_of_place = 13;  // degrees to 1e-11, or a micrometre: also subfaults of 1 cm are distinct
constexpr std::size_t rates_per_line = 6;
constexpr double no_hypocentre = -999.9;  // the value of Graves' programs

std::string line_of(std::initializer_list<double> values) {
  std::string line;
  for (const double value : values) line += (line.empty() ? "" : " ") + digits(value, precision);
  return line + "\n";
}

std::string place_of(double longitude, double latitude) {
  return digits(longitude, precision_of_place) + " " + digits(latitude, precision_of_place) + " ";
}

/// A comment. Names from files hold no control characters, but a line break would begin a line of data.
std::string comment(std::string_view text) {
  std::string line = "# ";
  for (const char c : text) line += static_cast<unsigned char>(c) < 0x20 ? ' ' : c;
  return line + "\n";
}

std::string plane_text(const SourceSegment& s) {
  const auto counts = std::to_string(s.along_strike) + " " + std::to_string(s.down_dip);
  const double length = s.cell_length * static_cast<double>(s.along_strike);
  const double width = s.cell_width * static_cast<double>(s.down_dip);
  return place_of(s.longitude, s.latitude) + counts + " " + line_of({km * length, km * width}) +
         line_of({s.strike, s.dip, km * s.top, s.has_hypocentre ? km * s.hypocentre_along_strike : no_hypocentre,
                  s.has_hypocentre ? km * s.hypocentre_down_dip : no_hypocentre});
}

void add_point(std::string& text, const FiniteSource& source, const SourceSegment& s, const SourcePoint& p,
               SrfVersion version) {
  const std::vector<double> rates = slip_rates(source, p);
  text += place_of(p.longitude, p.latitude);
  text += line_of({km * p.depth, s.strike, s.dip, cm2 * s.cell_area(), p.rupture_time, source.time_step});
  if (version == SrfVersion::v2) {
    text.back() = ' ';
    text += line_of({cm * p.s_wave_speed, g_per_cm3 * p.density});
  }
  text += digits(p.rake, precision) + " " + digits(cm * p.slip, precision) + " " + std::to_string(rates.size()) +
          " 0 0 0 0\n";
  for (std::size_t i = 0; i < rates.size(); ++i) {
    text += digits(cm * rates[i], precision);
    text += (i + 1) % rates_per_line == 0 || i + 1 == rates.size() ? '\n' : ' ';
  }
}

}  // namespace

std::string srf_text(const FiniteSource& source, const std::string& history, SrfVersion version) {
  std::string text = (version == SrfVersion::v2 ? "2.0\n" : "1.0\n") + comment(source.name) + comment(history);
  for (const std::string& note : source.notes) text += comment(note);
  if (!source.is_mesh) text += "PLANE " + std::to_string(source.segments.size()) + "\n";
  std::string points;
  std::size_t count = 0;
  for (const SourceSegment& segment : source.segments) {
    if (!source.is_mesh)
      text += plane_text(segment), points += "POINTS " + std::to_string(segment.points.size()) + "\n";
    for (const SourcePoint& point : segment.points) add_point(points, source, segment, point, version);
    count += segment.points.size();
  }
  if (source.is_mesh) text += "POINTS " + std::to_string(count) + "\n";
  return text + points;
}

namespace {

using finite_fault::FiniteSource;
using finite_fault::SourcePoint;
using finite_fault::SourceSegment;

constexpr double per_km = 1e-3;

double in_radians(double degrees) { return degrees * std::numbers::pi / 180; }

std::string exact(double value) { return digits(value, 10); }

/// Longitude, latitude and depth.
struct Location {
  double longitude, latitude, depth;
};

/// The location at a distance along strike and down dip from another one.
Location moved(Location from, const SourceSegment& s, double along, double down) {
  const double across = down * std::cos(in_radians(s.dip)), strike = in_radians(s.strike);
  const double east = along * std::sin(strike) + across * std::cos(strike);
  const double north = along * std::cos(strike) - across * std::sin(strike);
  return {from.longitude + east / (catalogue::m_per_degree * std::cos(in_radians(from.latitude))),
          from.latitude + north / catalogue::m_per_degree, from.depth + down * std::sin(in_radians(s.dip))};
}

/// The hypocentre, or the centre of the subfault that slips first.
Location hypocentre_of(const FiniteSource& source) {
  const SourcePoint* first = nullptr;
  for (const SourceSegment& s : source.segments) {
    if (s.has_hypocentre)
      return moved({s.longitude, s.latitude, s.top}, s, s.hypocentre_along_strike, s.hypocentre_down_dip);
    for (const SourcePoint& p : s.points)
      if (p.slip != 0 && (!first || p.rupture_time < first->rupture_time)) first = &p;
  }
  return {first->longitude, first->latitude, first->depth};
}

/// A depth of subfaults, with sums weighted by their potency, or equally if nothing slips there.
struct Level {
  double depth, modulus, density, weight;
};

std::vector<Level> levels_of(const FiniteSource& source) {
  constexpr double least_slip = 1e-12;  // in place of 0, for the mean of a row that does not slip
  std::vector<Level> all, levels;
  for (const SourceSegment& s : source.segments)
    for (const SourcePoint& p : s.points)
      all.push_back({p.depth, p.shear_modulus(), p.density, s.cell_area() * std::fmax(std::fabs(p.slip), least_slip)});
  std::sort(all.begin(), all.end(), [](const Level& a, const Level& b) { return a.depth < b.depth; });
  for (const Level& l : all) {
    if (levels.empty() || l.depth - levels.back().depth > 1) levels.push_back({l.depth, 0, 0, 0});
    Level& to = levels.back();
    to.modulus += l.modulus * l.weight, to.density += l.density * l.weight, to.weight += l.weight;
  }
  for (Level& l : levels) l.modulus /= l.weight, l.density /= l.weight;
  return levels;
}

std::string velocity_table(const FiniteSource& source) {
  const std::vector<Level> levels = levels_of(source);
  const double nu = source.poisson_ratio, p_over_s = std::sqrt(2 * (1 - nu) / (1 - 2 * nu));
  std::string text = "% VELOCITY-DENSITY STRUCTURE\n% No. of layers = " + std::to_string(levels.size()) +
                     "\n%\n%   DEPTH   P-VEL   S-VEL   DENS\n%   [km]   [km/s]   [km/s]   [g/cm^3]\n";
  for (std::size_t i = 0; i < levels.size(); ++i) {
    const double top = i == 0 ? 0 : (levels[i - 1].depth + levels[i].depth) / 2;
    const double speed = std::sqrt(levels[i].modulus / levels[i].density);
    text += "%   " + exact(per_km * top) + "   " + exact(per_km * p_over_s * speed) + "   " + exact(per_km * speed) +
            "   " + exact(per_km * levels[i].density) + "\n";
  }
  return text + "%\n";
}

/// "KEY = VALUE UNIT" for a value that may be unknown, which SRCMOD writes as 999.
std::string stated(const char* key, const std::optional<catalogue::MeasuredValue>& value, double factor,
                   const char* unit) {
  return std::string(key) + " = " + (value ? exact(factor * value->middle()) : "999") + " " + unit + " ";
}

std::string fsp_header(const DescribedSource& d, const Location& hypocentre) {
  const SourceSegment& s = d.source.segments.front();
  const double length = per_km * s.cell_length * static_cast<double>(s.along_strike);
  const double width = per_km * s.cell_width * static_cast<double>(s.down_dip);
  const double magnitude = (std::log10(std::fabs(d.source.moment)) - 9.1) / 1.5;
  const std::string name = printable(d.source.name);
  return "% Event : " + name + " " + d.event.date + " [slipfront]\n% EventTAG: " + name +
         "\n%\n% Loc  : LAT = " + exact(hypocentre.latitude) + " LON = " + exact(hypocentre.longitude) +
         " DEP = " + exact(per_km * hypocentre.depth) + "\n% Size : LEN = " + exact(length) +
         " km WID = " + exact(width) + " km Mw = " + digits(magnitude, 3) + " Mo = " + exact(d.source.moment) +
         " Nm\n% Mech : STRK = " + exact(s.strike) + " DIP = " + exact(s.dip) +
         " RAKE = " + exact(s.points.front().rake) + " Htop = " + exact(per_km * s.top) +
         " km\n% Rupt : HypX = " + exact(length / 2 + per_km * s.hypocentre_along_strike) +
         " km HypZ = " + exact(per_km * s.hypocentre_down_dip) + " km " + stated("avTr", d.event.rise_time, 1, "s") +
         stated("avVr", d.event.rupture_velocity_m_s, per_km, "km/s") +
         "\n%\n% Invs : Nx = " + std::to_string(s.along_strike) + " Nz = " + std::to_string(s.down_dip) +
         "\n% Invs : Dx = " + exact(per_km * s.cell_length) + " km Dz = " + exact(per_km * s.cell_width) +
         " km\n% Invs : Nsg = " + std::to_string(d.source.segments.size()) + "\n%\n";
}

std::string fsp_segment(const SourceSegment& s, std::size_t number, const Location& hypocentre) {
  const double length = s.cell_length * static_cast<double>(s.along_strike);
  const double width = s.cell_width * static_cast<double>(s.down_dip);
  std::string text = "% SEGMENT # " + std::to_string(number) + ": STRIKE = " + exact(s.strike) +
                     " deg DIP = " + exact(s.dip) + " deg\n% LEN = " + exact(per_km * length) +
                     " km WID = " + exact(per_km * width) + " km\n% Nsbfs = " + std::to_string(s.points.size()) +
                     " subfaults\n%   LAT LON X==EW Y==NS Z SLIP RAKE TRUP RISE\n% ---\n";
  for (const SourcePoint& p : s.points) {
    const double north = catalogue::m_per_degree * (p.latitude - hypocentre.latitude);
    const double east = catalogue::m_per_degree * std::cos(in_radians(p.latitude)) *
                        std::remainder(p.longitude - hypocentre.longitude, 360);
    for (const double value : {p.latitude, p.longitude, per_km * east, per_km * north, per_km * p.depth, p.slip, p.rake,
                               p.rupture_time, p.rise_time})
      text += " " + exact(value);
    text += "\n";
  }
  return text;
}

}  // namespace

std::string fsp_text(const DescribedSource& described, const std::string& history) {
  const Location hypocentre = hypocentre_of(described.source);
  std::string text = "% ---------------------- FINITE-SOURCE RUPTURE MODEL ----------------------\n%\n";
  text += fsp_header(described, hypocentre) + velocity_table(described.source);
  text += "% ---\n% " + printable(history) + "\n% Coordinates are given for center of each subfault\n";
  for (std::size_t k = 0; k < described.source.segments.size(); ++k)
    text += fsp_segment(described.source.segments[k], k + 1, hypocentre);
  return text;
}

std::string subfaults_csv(const FiniteSource& source) {
  std::string text =
      "segment,longitude,latitude,depth,length,width,strike,dip,rake,slip,mu,density,rupture_time,rise_time\n";
  for (std::size_t k = 0; k < source.segments.size(); ++k) {
    const SourceSegment& s = source.segments[k];
    for (const SourcePoint& p : s.points) {
      const Location edge = moved({p.longitude, p.latitude, p.depth}, s, 0, -s.cell_width / 2);
      text += std::to_string(k + 1);
      for (const double value : {edge.longitude, edge.latitude, edge.depth, s.cell_length, s.cell_width, s.strike,
                                 s.dip, p.rake, p.slip, p.shear_modulus(), p.density, p.rupture_time, p.rise_time})
        text += "," + digits(value, 13);
      text += "\n";
    }
  }
  return text;
}

}  // namespace slipfront::record
