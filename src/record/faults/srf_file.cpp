#include "record/faults/srf_file.hpp"

#include <initializer_list>
#include <string_view>
#include <vector>

#include "foundation/text/digits.hpp"
#include "record/files/text_file.hpp"

namespace slipfront::record {
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

void add_point(std::string& text, const FiniteSource& source, const SourceSegment& s, const SourcePoint& p) {
  const std::vector<double> rates = slip_rates(source, p);
  text += place_of(p.longitude, p.latitude);
  text += line_of({km * p.depth, s.strike, s.dip, cm2 * s.cell_area(), p.rupture_time, source.time_step,
                   cm * p.s_wave_speed, g_per_cm3 * p.density});
  text += digits(p.rake, precision) + " " + digits(cm * p.slip, precision) + " " + std::to_string(rates.size()) +
          " 0 0 0 0\n";
  for (std::size_t i = 0; i < rates.size(); ++i) {
    text += digits(cm * rates[i], precision);
    text += (i + 1) % rates_per_line == 0 || i + 1 == rates.size() ? '\n' : ' ';
  }
}

}  // namespace

std::string srf_text(const FiniteSource& source, const std::string& history) {
  std::string text = "2.0\n" + comment(source.name) + comment(history);
  for (const std::string& note : source.notes) text += comment(note);
  text += "PLANE " + std::to_string(source.segments.size()) + "\n";
  for (const SourceSegment& segment : source.segments) text += plane_text(segment);
  for (const SourceSegment& segment : source.segments) {
    text += "POINTS " + std::to_string(segment.points.size()) + "\n";
    for (const SourcePoint& point : segment.points) add_point(text, source, segment, point);
  }
  return text;
}

void write_srf(const std::string& path, const FiniteSource& source, const std::string& history) {
  write_text(path, srf_text(source, history));
}

}  // namespace slipfront::record
