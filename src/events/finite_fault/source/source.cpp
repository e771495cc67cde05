#include "events/finite_fault/source/source.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>

#include "events/finite_fault/along_fault.hpp"
#include "math/digits.hpp"
#include "slipfront/friction/ratio/table.hpp"
#include "slipfront/theory/medium/medium.hpp"
#include "slipfront/theory/rupture/relations.hpp"

namespace slipfront::finite_fault {

using catalogue::FaultModel;

namespace {

/// Sigma- of a pulse with this rupture velocity, within the range of the table of friction ratios.
double pulse_stress(double velocity, double speed) {
  const auto [least, most] = friction_ratio::stress_range();
  const double fastest = rupture::from_stress(most).rupture_velocity;
  const double ratio = std::fmin(velocity / speed, fastest);
  return std::clamp(rupture::from_rupture_velocity(ratio).stress, least, most);
}

/// A step of 1, 2 or 5 times a power of ten, at most a tenth of the shortest rise time. If rise times differ by more
/// than a factor of 200, it is at most 1/2000 of the longest one instead. It is never below a microsecond.
double step_for(const FiniteSource& source) {
  double shortest_time = HUGE_VAL, longest = 0;
  for (const SourceSegment& segment : source.segments)
    for (const SourcePoint& p : segment.points)
      if (p.slip != 0) {
        shortest_time = std::fmin(shortest_time, p.rise_time);
        longest = std::fmax(longest, p.rise_time);
      }
  const double wanted = std::fmax(std::fmax(shortest_time / 10, longest / 2000), 1e-6);
  const double decade = std::pow(10, std::floor(std::log10(wanted)));
  const double mantissa = wanted / decade * (1 + 1e-12);
  return decade * (mantissa >= 5 ? 5 : mantissa >= 2 ? 2 : 1);
}

/// Fraction of the slip at time `share` times the rise time: t R(Gamma t / T), where R is the mean of W over time.
double released(const FiniteSource& source, double share) {
  if (share >= 1) return 1;
  const auto slip_to = [&](double s) {
    return s * friction_ratio::evaluate(friction_ratio::SlipVelocityKind::time_mean, source.closure, source.stress,
                                        source.damping_number * s)
                   .value;
  };
  return slip_to(share) / slip_to(1);
}

/// The velocity that stands for the whole rupture, and how it was chosen.
struct ChosenVelocity {
  double m_s;
  std::string how;
};
ChosenVelocity chosen_velocity(const FaultModel& model, double s_wave_speed) {
  const auto& stated = model.observation.rupture_velocity_m_s;
  if (stated) return {stated->middle(), "avVr of the file"};
  return {0.8 * s_wave_speed, "0.8 of the S speed at the hypocentre, because the file has no avVr"};
}

/// The model with a segment for each subfault of segments without a grid.
FaultModel with_mesh_divided(FaultModel model) {
  std::vector<catalogue::FaultSegment> segments;
  for (catalogue::FaultSegment& from : model.segments) {
    if (from.down_dip > 0) {
      segments.push_back(std::move(from));
      continue;
    }
    for (const catalogue::FaultPatch& patch : from.patches) {
      catalogue::FaultSegment& one = segments.emplace_back();
      one.line = from.line;
      one.strike = patch.strike ? patch.strike : from.strike;
      one.dip = patch.dip ? patch.dip : from.dip;
      one.cell_length = from.cell_length, one.cell_width = from.cell_width;
      if (patch.area) one.cell_length = one.cell_width = std::sqrt(*patch.area);
      one.along_strike = one.down_dip = 1;
      one.patches = {patch};
    }
  }
  model.segments = std::move(segments);
  return model;
}

bool has_mesh(const FaultModel& model) {
  return std::any_of(model.segments.begin(), model.segments.end(), [](const auto& s) { return s.down_dip == 0; });
}

}  // namespace

FiniteSource finite_source(const FaultModel& model, const medium::Defaults& defaults, const SourceOptions& options) {
  if (options.any_mesh && has_mesh(model)) {
    FiniteSource mesh = finite_source(with_mesh_divided(model), defaults, options);
    mesh.is_mesh = true;
    return mesh;
  }
  source::Builder builder(model, defaults);
  FiniteSource out = builder.planes();
  out.damping_number = options.damping_number;
  out.closure = options.closure;
  const medium::Elastic elastic = medium::elastic(model.observation, defaults);
  out.poisson_ratio = elastic.poisson_ratio;
  const ChosenVelocity velocity = chosen_velocity(model, builder.s_wave_speed_at_hypocentre());
  out.stress = pulse_stress(velocity.m_s, elastic.speed);
  builder.add_rupture_times(out, velocity.m_s, velocity.how);
  builder.add_rise_times(out);
  builder.add_local_velocities(out, elastic.speed);
  out.time_step = step_for(out);
  out.notes.push_back("slip rates: W(0, t) of the pulse with Sigma- = " + digits(out.stress, 4) +
                      " mu A / pi and damping number " + digits(out.damping_number, 4) +
                      " at the end of the rise time (closure " + friction::name_of(out.closure) +
                      "), means over steps of " + shortest(out.time_step) + " s");
  return out;
}

std::vector<double> slip_rates(const FiniteSource& source, const SourcePoint& point) {
  std::vector<double> rates;
  if (point.slip == 0) return rates;
  const auto steps = static_cast<std::size_t>(std::ceil(point.rise_time / source.time_step * (1 - 1e-12)));
  double before = 0;
  for (std::size_t step = 1; step <= steps; ++step) {
    const double end = static_cast<double>(step) * source.time_step;
    const double after = step < steps ? released(source, end / point.rise_time) : 1;
    rates.push_back(point.slip * (after - before) / source.time_step);
    before = after;
  }
  return rates;
}

}  // namespace slipfront::finite_fault

namespace slipfront::finite_fault::source {

using catalogue::FaultPatch;

namespace {

/// Calls `visit` with each subfault of the source and of the model.
template <class Source, class Visit>
void for_each_point(Source& source, const catalogue::FaultModel& model, const Visit& visit) {
  for (std::size_t k = 0; k < source.segments.size(); ++k)
    for (std::size_t i = 0; i < source.segments[k].points.size(); ++i)
      visit(source.segments[k].points[i], model.segments[k].patches[i]);
}

std::string count_of(std::size_t count, std::size_t all) {
  return std::to_string(count) + " of " + std::to_string(all) + " subfaults";
}

}  // namespace

void Builder::add_rupture_times(FiniteSource& out, double velocity, const std::string& how) const {
  std::size_t all = 0, own = 0;
  bool any_after_start = false;  // a column that is 0 everywhere is a placeholder
  for_each_point(out, model_, [&](const SourcePoint&, const FaultPatch& from) {
    ++all;
    if (!from.rupture_time) return;
    ++own;
    any_after_start = any_after_start || *from.rupture_time > 0;
  });
  if (!any_after_start) own = 0;
  if (own < all && !model_.hypocentre_depth)
    refuse(model_.observation.line, "DEP",
           "neither rupture times (TRUP) of all subfaults nor a depth of the hypocentre",
           "a column TRUP, or DEP of Loc");
  double first = 0;
  for_each_point(out, model_, [&](SourcePoint& p, const FaultPatch& from) {
    p.rupture_time = own > 0 && from.rupture_time
                         ? *from.rupture_time
                         : std::hypot(from.east, from.north, from.depth - *model_.hypocentre_depth) / velocity;
    first = std::fmin(first, p.rupture_time);
  });
  for_each_point(out, model_, [&](SourcePoint& p, const FaultPatch&) { p.rupture_time -= first; });
  if (own > 0) out.notes.push_back("rupture times: column TRUP for " + count_of(own, all));
  if (own < all)
    out.notes.push_back("rupture times: distance from the hypocentre over " + digits(velocity) + " m/s (" + how +
                        ") for " + count_of(all - own, all));
  if (first < 0)
    out.notes.push_back("rupture times begin below 0: all are " + shortest(-first) + " s later than in the file");
}

void Builder::add_rise_times(FiniteSource& out) const {
  const auto& stated = model_.observation.rise_time;
  // Somerville et al. (1999): 2.03e-9 (moment in dyn cm)^(1/3) s.
  const double mean = stated ? stated->middle() : 2.03e-9 * std::cbrt(1e7 * std::fabs(out.moment));
  std::size_t all = 0, own = 0;
  for_each_point(out, model_, [&](SourcePoint& p, const FaultPatch& from) {
    p.rise_time = from.rise_time.value_or(mean);
    ++all;
    if (from.rise_time) ++own;
  });
  if (own > 0) out.notes.push_back("rise times: column RISE for " + count_of(own, all));
  if (own == all) return;
  out.notes.push_back(
      "rise times: " + digits(mean, 4) + " s for " + count_of(all - own, all) +
      (stated ? ", the mean of the file" : ", by the moment (Somerville et al. 1999), because the file has none"));
}

void Builder::add_local_velocities(FiniteSource& out, double speed) const {
  const std::vector<LocalState> states = along_fault(model_.observation, defaults_);
  for_each_point(out, model_, [&](SourcePoint& p, const FaultPatch& from) {
    p.rupture_velocity = states[from.row].rupture_velocity_m_s;
  });
  if (const std::string warning = warning_of(faster_than(states, speed), speed); !warning.empty())
    out.notes.push_back(warning);
}

}  // namespace slipfront::finite_fault::source

namespace slipfront::finite_fault {
namespace {

/// Stress at a distance (along strike, up dip) from the centre of a rectangle that slips by 1, over mu / (4 pi).
struct Kernel {
  double along, up;  ///< stress along strike by slip along strike, and up dip by slip up dip
  double cross;      ///< stress in one direction by slip in the other
};

/// Second derivatives of the integral of 1 / r over the rectangle. In space, 1 / k is 1 / (2 pi r) and k_i is -i d_i.
Kernel kernel(double x, double y, double length, double width, double poisson_ratio) {
  double xx = 0, yy = 0, xy = 0;
  for (const int i : {1, -1})
    for (const int j : {1, -1}) {
      const double a = x + i * length / 2, b = y + j * width / 2, r = std::hypot(a, b);
      xx -= i * j * b / (a * r);
      yy -= i * j * a / (b * r);
      xy += i * j / r;
    }
  const double mode_2 = 1 / (1 - poisson_ratio);
  return {mode_2 * xx + yy, xx + mode_2 * yy, (mode_2 - 1) * xy};
}

/// Components along strike and up dip, of slip or of stress.
struct InPlane {
  double along, up;
};
InPlane direction(const SourcePoint& p) {
  const double rake = p.rake * std::numbers::pi / 180;
  return {std::cos(rake), std::sin(rake)};
}

/// Sums the stress of all subfaults at subfault (column, row). Rows are counted downwards.
InPlane traction_at(const SourceSegment& s, const std::vector<Kernel>& kernels, const std::vector<InPlane>& slips,
                    std::size_t column, std::size_t row) {
  InPlane sum{0, 0};
  for (std::size_t j = 0; j < s.down_dip; ++j)
    for (std::size_t i = 0; i < s.along_strike; ++i) {
      const InPlane& slip = slips[j * s.along_strike + i];
      const std::size_t across = i > column ? i - column : column - i, down = j > row ? j - row : row - j;
      const Kernel& k = kernels[down * s.along_strike + across];
      const double sign = (i > column) == (j < row) ? 1 : -1;  // the cross term is odd in x and in y
      sum.along += k.along * slip.along + sign * k.cross * slip.up;
      sum.up += k.up * slip.up + sign * k.cross * slip.along;
    }
  return sum;
}

}  // namespace

double shear_modulus_of(const SourceSegment& segment) {
  double slip = 0, weighted = 0, plain = 0;
  for (const SourcePoint& p : segment.points) {
    slip += std::fabs(p.slip);
    weighted += std::fabs(p.slip) * p.shear_modulus();
    plain += p.shear_modulus() / static_cast<double>(segment.points.size());
  }
  return slip > 0 ? weighted / slip : plain;
}

std::vector<double> static_stress_drop(const SourceSegment& s, double poisson_ratio) {
  std::vector<Kernel> kernels;
  for (std::size_t j = 0; j < s.down_dip; ++j)
    for (std::size_t i = 0; i < s.along_strike; ++i)
      kernels.push_back(kernel(static_cast<double>(i) * s.cell_length, static_cast<double>(j) * s.cell_width,
                               s.cell_length, s.cell_width, poisson_ratio));
  std::vector<InPlane> slips;
  for (const SourcePoint& p : s.points) {
    const InPlane d = direction(p);
    slips.push_back({p.slip * d.along, p.slip * d.up});
  }
  const double unit = shear_modulus_of(s) / (4 * std::numbers::pi);
  std::vector<double> drops;
  for (std::size_t j = 0; j < s.down_dip; ++j)
    for (std::size_t i = 0; i < s.along_strike; ++i) {
      const InPlane t = traction_at(s, kernels, slips, i, j), d = direction(s.points[j * s.along_strike + i]);
      drops.push_back(-unit * (t.along * d.along + t.up * d.up));
    }
  return drops;
}

}  // namespace slipfront::finite_fault

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
    refuse(from.line, "subfault", "the subfaults form no grid",
           "rows of equal depth with equally many subfaults; event -o OUT.srf needs none");
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
