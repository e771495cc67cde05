#pragma once
/// \file
/// Turns a finite-fault model into a kinematic source: rupture times, rise times and slip-rate functions on planar
/// segments. The moment is that of the model.
///
/// Static stress drop on a planar segment from its slip.
///
/// The steps that build a source from a finite-fault model. Private to src/events/finite_fault/source.

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "events/catalogue/fault_model.hpp"
#include "slipfront/friction/friction.hpp"
#include "slipfront/theory/medium/constants.hpp"

namespace slipfront::finite_fault {

/// A subfault of a source. Positions are those of its centre.
struct SourcePoint {
  double longitude, latitude;    ///< degrees
  double depth;                  ///< m
  double rake;                   ///< degrees
  double slip;                   ///< m
  double s_wave_speed, density;  ///< m/s, kg/m^3
  double rupture_time;           ///< s, since the first subfault began to slip or, if that is earlier, since the origin
  double rise_time;              ///< s
  std::optional<double> rupture_velocity;  ///< m/s, from the rupture times around it

  double shear_modulus() const { return density * s_wave_speed * s_wave_speed; }
};

/// A planar segment, with its subfaults by row from the top down, and in each row in the direction of strike.
struct SourceSegment {
  double strike, dip;                  ///< degrees
  double cell_length, cell_width;      ///< m, size of a subfault along strike and down dip
  std::size_t along_strike, down_dip;  ///< numbers of subfaults
  double longitude, latitude, top;     ///< the middle of the upper edge: degrees, and depth in m
  bool has_hypocentre = false;         ///< the hypocentre is nearest to this segment
  double hypocentre_along_strike = 0;  ///< m, from the middle of the upper edge
  double hypocentre_down_dip = 0;      ///< m, from the upper edge
  std::vector<SourcePoint> points = {};

  double cell_area() const { return cell_length * cell_width; }
};

/// How to complete a model.
struct SourceOptions {
  double damping_number = 10;  ///< Gamma at the end of the rise time; 0 means constant slip rate
  friction::Closure closure = friction::Closure::consistent;
  /// Subfaults that form no grid, such as those of a curved mesh, become segments of one subfault. Otherwise they are
  /// refused.
  bool any_mesh = false;
};

struct FiniteSource {
  std::string name;
  std::vector<SourceSegment> segments;
  double stress;  ///< Sigma- of the pulse, in mu A / pi
  double damping_number;
  friction::Closure closure;
  double time_step;  ///< s, of the slip-rate functions
  double poisson_ratio;
  double moment;                   ///< N m
  bool is_mesh = false;            ///< there is a segment for each subfault, a square of its area
  std::vector<std::string> notes;  ///< every choice that was made, one line each
};

/// \throws InputError (file, line, problem, allowed) if the model has no subfaults with positions, no strike, dip, rake
/// or size, no grid, no slip, or neither rupture times nor a hypocentre.
FiniteSource finite_source(const catalogue::FaultModel& model, const medium::Defaults& defaults,
                           const SourceOptions& options);

/// The slip rate of a subfault in m/s: means over successive time steps, from the rupture time on. The sum times the
/// time step is the slip. It is empty if the slip is 0.
///
/// The slip rate is that of the pulse at x = 0, W(0, t), from t = 0 to the rise time, where the damping number is
/// `source.damping_number`. It is multiplied by the factor that gives the slip.
std::vector<double> slip_rates(const FiniteSource& source, const SourcePoint& point);

/// Stress drop in Pa at the centre of each subfault, in the direction of its rake, in the order of the points. Negative
/// values are increases of stress.
///
/// The medium is a homogeneous full space with the shear modulus `shear_modulus_of(segment)`. Each subfault slips
/// uniformly. In wave numbers the change of the shear stress i by slip D_j is (Andrews 1980)
///
///     -(mu / 2) (k delta_ij + nu / (1 - nu) k_i k_j / k) D_j
///
/// We sum its exact integral over every rectangle instead of a Fourier series, so nothing is periodic. The free surface
/// and other segments are left out.
std::vector<double> static_stress_drop(const SourceSegment& segment, double poisson_ratio);

/// Mean shear modulus of a segment in Pa, weighted by slip. If nothing slips, all subfaults count equally.
double shear_modulus_of(const SourceSegment& segment);

}  // namespace slipfront::finite_fault

namespace slipfront::finite_fault::source {

class Builder {
 public:
  Builder(const catalogue::FaultModel& model, const medium::Defaults& defaults);

  /// Segments, points, rock and moment; times are still 0. \throws InputError.
  FiniteSource planes();
  /// S speed in m/s at the hypocentre. If its depth is unknown, at the middle of the first segment.
  double s_wave_speed_at_hypocentre() const;
  /// TRUP of the file. A subfault without TRUP has the distance from the hypocentre over `velocity` in m/s. \throws
  /// InputError if the depth of the hypocentre is not known.
  void add_rupture_times(FiniteSource& out, double velocity, const std::string& how) const;
  /// RISE of the file, or the mean rise time of the file, or a scaling relation.
  void add_rise_times(FiniteSource& out) const;
  /// Velocities from the rupture times of the file, and a note on those above c.
  void add_local_velocities(FiniteSource& out, double speed) const;

 private:
  SourceSegment plane(const catalogue::FaultSegment& from) const;
  SourcePoint point(const catalogue::FaultPatch& from, double cell_area) const;
  void place_hypocentre(FiniteSource& out) const;
  std::string rock_note() const;
  [[noreturn]] void refuse(std::size_t line, const std::string& key, const std::string& problem,
                           const std::string& allowed) const;

  const catalogue::FaultModel& model_;
  const medium::Defaults& defaults_;
  double default_s_wave_speed_ = 0, default_density_ = 0;  ///< used if there is no velocity table
};

}  // namespace slipfront::finite_fault::source
