#include "slipfront/text/output/slip_event.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>

namespace slipfront::output {
namespace {

constexpr SlipEventColumn columns[] = {
    {{"event_onset", "time at which the slip velocity of a part of the chain rises above the threshold", "b / (c A)",
      "Eq. 1"},
     &SlipEvent::onset},
    {{"event_duration", "time until all parts are below half the threshold", "b / (c A)", "Eq. 1"},
     &SlipEvent::duration},
    {{"event_slip", "slip, mean over the chain, without slip in other events", "b / (2 pi)", "Eq. 1"},
     &SlipEvent::slip},
    {{"event_largest_slip", "slip of the part that slips most", "b / (2 pi)", "Eq. 1"}, &SlipEvent::largest_slip},
    {{"event_load", "mean force F on a site, or the stress at a pulled end, before the event", "", "Eq. 1"},
     &SlipEvent::load},
    {{"event_stress_drop", "fall of the mean force F on a site, or of the stress at a pulled end", "", "Eq. 1"},
     &SlipEvent::stress_drop},
    {{"event_peak_velocity", "greatest slip velocity of a part", "c A / pi", "Eq. 1"}, &SlipEvent::peak_velocity},
    {{"event_origin", "position of the part that moves first", "b / A", "Eq. 1",
      "all parts moved within a thousandth of the time that waves take between them, so that rounding decides which "
      "was first"},
     &SlipEvent::origin},
    {{"event_length", "length of the parts that move", "b / A", "Eq. 1"}, &SlipEvent::length},
    {{"event_rupture_velocity", "velocity of the front, fitted over the parts that move", "c", "Eq. 1",
      "fewer than three parts moved, all moved at once, or the fit is faster than c"},
     &SlipEvent::rupture_velocity},
    {{"event_complete", "1, or 0 if the run ended within the event", "", "Eq. 1"}, &SlipEvent::complete},
    {{"event_merged", "number of other events that the event has met, which are part of it", "", "Eq. 1"},
     &SlipEvent::merged},
};

constexpr MemberArray<FrontRecord> of_fronts[] = {
    {{"event_arrival", "time at which the slip velocity first exceeds the threshold in an event", "b / (c A)", "Eq. 1",
      "the slip velocity does not exceed it"},
     &FrontRecord::arrival},
    {{"event_stress_ahead", "shear stress when the event begins", "mu A / pi", "Eq. 1"}, &FrontRecord::stress},
    {{"event_traction_ahead", "force of friction and substrate when the event begins", "mu A^2 / (pi (1 - nu))",
      "Eq. 1"},
     &FrontRecord::traction},
};

double median(std::vector<double> values) {
  if (values.empty()) return std::numeric_limits<double>::quiet_NaN();
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  if (values.size() % 2 == 1) return *middle;
  return (*middle + *std::max_element(values.begin(), middle)) / 2;
}

}  // namespace

EventSeries series_of(const std::vector<SlipEvent>& events) {
  std::vector<double> intervals, drops, velocities;
  for (std::size_t i = 0; i < events.size(); ++i) {
    if (i > 0) intervals.push_back(events[i].onset - events[i - 1].onset);
    if (events[i].complete == 0) continue;
    drops.push_back(events[i].stress_drop);
    velocities.push_back(events[i].peak_velocity);
  }
  return {.count = static_cast<long>(events.size()),
          .recurrence_time = median(std::move(intervals)),
          .stress_drop = median(std::move(drops)),
          .peak_velocity = median(std::move(velocities))};
}

const Description front_position = {"position", "position at which the arrival of slip events is recorded", "b / A",
                                    "Eq. 1"};

std::span<const MemberArray<FrontRecord>> front_columns() { return of_fronts; }

std::span<const SlipEventColumn> slip_event_columns() { return columns; }

std::vector<SlipEventColumn> columns_without_value(const std::vector<SlipEvent>& events) {
  std::vector<SlipEventColumn> found;
  for (const SlipEventColumn& column : columns)
    if (std::any_of(events.begin(), events.end(), [&](const SlipEvent& e) { return std::isnan(e.*column.value); }))
      found.push_back(column);
  return found;
}

std::string_view SlipEventColumn::key() const { return about.name.substr(std::string_view("event_").size()); }

std::string_view unit_of_load(bool pulled_end) { return pulled_end ? "mu A / pi" : "mu A^2 / (pi (1 - nu))"; }

Description description_of(const SlipEventColumn& column, bool pulled_end) {
  Description about = column.about;
  if (column.value == &SlipEvent::stress_drop || column.value == &SlipEvent::load)
    about.dimensional_unit = unit_of_load(pulled_end);
  return about;
}

}  // namespace slipfront::output
