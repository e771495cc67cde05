#include "runs/record/faults/fault_files.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <functional>
#include <initializer_list>
#include <string_view>
#include <vector>

#include "events/finite_fault/source/source.hpp"
#include "math/digits.hpp"
#include "runs/record/netcdf/netcdf.hpp"
#include "system/files/whole_file.hpp"

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
  text += "PLANE " + std::to_string(source.segments.size()) + "\n";
  for (const SourceSegment& segment : source.segments) text += plane_text(segment);
  for (const SourceSegment& segment : source.segments) {
    text += "POINTS " + std::to_string(segment.points.size()) + "\n";
    for (const SourcePoint& point : segment.points) add_point(text, source, segment, point, version);
  }
  return text;
}

}  // namespace slipfront::record
