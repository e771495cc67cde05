#include "events/finite_fault/source/build.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "math/digits.hpp"
#include "slipfront/theory/medium/medium.hpp"

namespace slipfront::finite_fault::source {

using catalogue::FaultPatch;
using catalogue::FaultSegment;

namespace {

double radians(double degrees) { return degrees * std::numbers::pi / 180; }

}  // namespace

Builder::Builder(const catalogue::FaultModel& model, const medium::Defaults& defaults)
    : model_(model), defaults_(defaults) {
  const medium::Elastic e = medium::elastic(model.observation, defaults);
  default_s_wave_speed_ = e.speed * std::sqrt((1 - e.poisson_ratio) / 2);  // c = c_s sqrt(2 / (1 - nu))
  default_density_ = e.shear_modulus / (default_s_wave_speed_ * default_s_wave_speed_);
}

void Builder::refuse(std::size_t line, const std::string& key, const std::string& problem,
                     const std::string& allowed) const {
  throw InputError({.file = model_.observation.file, .line = line, .key = key, .problem = problem, .allowed = allowed});
}

double Builder::s_wave_speed_at_hypocentre() const {
  if (model_.rock.empty()) return default_s_wave_speed_;
  const std::vector<FaultPatch>& patches = model_.segments.front().patches;
  return catalogue::rock_at(model_.rock, model_.hypocentre_depth.value_or(patches[patches.size() / 2].depth))
      .s_wave_speed;
}

SourcePoint Builder::point(const FaultPatch& from, double cell_area) const {
  SourcePoint out{.longitude = from.longitude,
                  .latitude = from.latitude,
                  .depth = from.depth,
                  .rake = from.rake.value_or(model_.rake.value_or(NAN)),
                  .slip = from.slip,
                  .s_wave_speed = default_s_wave_speed_,
                  .density = default_density_,
                  .rupture_time = 0,
                  .rise_time = 0,
                  .rupture_velocity = {}};
  if (!model_.rock.empty()) {
    const catalogue::RockLayer& layer = catalogue::rock_at(model_.rock, from.depth);
    out.s_wave_speed = layer.s_wave_speed, out.density = layer.density;
  }
  if (from.shear_modulus) {
    out.density = from.density.value_or(default_density_);
    // All subfaults of a segment get one size. The modulus takes up the difference, so that the moment stays.
    out.s_wave_speed = std::sqrt(*from.shear_modulus * from.area.value_or(cell_area) / cell_area / out.density);
  }
  return out;
}

/// Positions relative to the first subfault, so that longitudes near 180 degrees have a mean.
SourceSegment Builder::plane(const FaultSegment& from) const {
  if (!from.strike || !from.dip)
    refuse(from.line, "STRIKE", "no strike and dip for this segment",
           "STRIKE and DIP of the segment, or STRK and DIP of Mech");
  if (from.down_dip == 0)
    refuse(from.line, "subfault", "the subfaults form no grid", "rows of equal depth with equally many subfaults");
  if (!from.cell_length || !from.cell_width)
    refuse(from.line, "Dx", "no size of a subfault", "Dx and Dz, or LEN and WID");
  SourceSegment out{.strike = *from.strike,
                    .dip = *from.dip,
                    .cell_length = *from.cell_length,
                    .cell_width = *from.cell_width,
                    .along_strike = from.along_strike,
                    .down_dip = from.down_dip,
                    .longitude = 0,
                    .latitude = 0,
                    .top = 0};
  const FaultPatch& first = from.patches.front();
  for (std::size_t i = 0; i < from.along_strike; ++i) {
    const double n = static_cast<double>(from.along_strike);
    out.longitude += std::remainder(from.patches[i].longitude - first.longitude, 360) / n;
    out.latitude += (from.patches[i].latitude - first.latitude) / n;
    out.top += from.patches[i].depth / n;
  }
  out.longitude += first.longitude, out.latitude += first.latitude;
  const double half = *from.cell_width / 2, across = half * std::cos(radians(*from.dip));
  out.longitude -=
      across * std::cos(radians(*from.strike)) / (catalogue::m_per_degree * std::cos(radians(out.latitude)));
  out.latitude += across * std::sin(radians(*from.strike)) / catalogue::m_per_degree;
  out.top = std::fmax(0, out.top - half * std::sin(radians(*from.dip)));
  for (const FaultPatch& patch : from.patches) out.points.push_back(point(patch, out.cell_area()));
  for (const SourcePoint& p : out.points)
    if (!std::isfinite(p.rake)) refuse(from.line, "RAKE", "no rake", "a column RAKE, or RAKE of Mech");
  return out;
}

void Builder::place_hypocentre(FiniteSource& out) const {
  if (!model_.hypocentre_depth) return;
  double nearest = HUGE_VAL;
  std::size_t at = 0;
  for (std::size_t k = 0; k < out.segments.size(); ++k)
    for (const FaultPatch& p : model_.segments[k].patches) {
      const double distance = std::hypot(p.east, p.north, p.depth - *model_.hypocentre_depth);
      if (distance < nearest) nearest = distance, at = k;
    }
  SourceSegment& segment = out.segments[at];
  const FaultSegment& from = model_.segments[at];
  const double strike = radians(segment.strike), dip = radians(segment.dip);
  double along = 0, across = 0, n = static_cast<double>(from.along_strike);
  for (std::size_t i = 0; i < from.along_strike; ++i) {  // from the upper row to the epicentre, which is the origin
    const FaultPatch& p = from.patches[i];
    along -= (p.east * std::sin(strike) + p.north * std::cos(strike)) / n;
    across -= (p.east * std::cos(strike) - p.north * std::sin(strike)) / n;
  }
  segment.has_hypocentre = true;
  segment.hypocentre_along_strike = along;
  segment.hypocentre_down_dip = across * std::cos(dip) +
                                (*model_.hypocentre_depth - from.patches.front().depth) * std::sin(dip) +
                                segment.cell_width / 2;
}

std::string Builder::rock_note() const {
  if (model_.segments.front().patches.front().shear_modulus) return "shear modulus of each subfault from the file";
  if (!model_.rock.empty()) return "shear modulus from the velocity table at the depth of each subfault";
  return "no velocity table: shear modulus " + digits(default_density_ * std::pow(default_s_wave_speed_, 2), 4) +
         " Pa everywhere, with S speed " + digits(default_s_wave_speed_, 4) + " m/s";
}

FiniteSource Builder::planes() {
  if (model_.segments.empty())
    refuse(model_.observation.line, "X", "no subfaults with positions", "columns X==EW, Y==NS and Z");
  FiniteSource out{};
  out.name = model_.observation.name;
  out.notes = model_.notes;
  double potency = 0;
  std::size_t backwards = 0;
  for (const FaultSegment& from : model_.segments) {
    const SourceSegment& segment = out.segments.emplace_back(plane(from));
    for (const SourcePoint& p : segment.points) {
      out.moment += p.shear_modulus() * segment.cell_area() * p.slip;
      potency += segment.cell_area() * std::fabs(p.slip);
      if (p.slip < 0) ++backwards;
    }
  }
  if (potency == 0) refuse(model_.segments.front().line, "SLIP", "no subfault slips", "at least one slip other than 0");
  if (!std::isfinite(out.moment))
    refuse(model_.segments.front().line, "SLIP", "the moment is not finite", "finite slip and sizes");
  place_hypocentre(out);
  out.notes.push_back(rock_note());
  out.notes.push_back("moment " + digits(out.moment, 7) + " N m" +
                      (model_.moment ? "; the header states " + digits(*model_.moment, 4) + " N m" : std::string()));
  if (backwards > 0)
    out.notes.push_back("subfaults that slip backwards, written with negative slip: " + std::to_string(backwards));
  return out;
}

}  // namespace slipfront::finite_fault::source
