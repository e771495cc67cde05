#include <algorithm>
#include <cmath>

#include "finite_fault/along_fault.hpp"
#include "finite_fault/source/build.hpp"
#include "foundation/text/digits.hpp"

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
