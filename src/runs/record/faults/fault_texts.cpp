#include "runs/record/faults/fault_texts.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>
#include <vector>

#include "math/digits.hpp"
#include "text/characters.hpp"

namespace slipfront::record {
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
