#pragma once
/// \file
/// The steps that build a source from a finite-fault model. Private to src/events/finite_fault/source.

#include <string>

#include "events/finite_fault/source/source.hpp"

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
