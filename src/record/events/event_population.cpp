#include <string>

#include "record/events/event_layout.hpp"
#include "results/quantities.hpp"

namespace slipfront::record::event_layout {
namespace {

using catalogue::Decade;
using results::Axis;
using results::NumberColumn;

NumberColumn described(const std::string& name, const std::string& long_name, std::string_view dimensional_unit,
                       std::string_view reference, std::string_view unit = "1") {
  return {name, long_name, unit, dimensional_unit, reference, Axis::none, 1, {}};
}

template <class Row, class Get>
std::vector<double> each(const std::vector<Row>& rows, Get&& get) {
  std::vector<double> values;
  values.reserve(rows.size());
  for (const Row& row : rows) values.push_back(static_cast<double>(get(row)));
  return values;
}

/// Adds the quantiles of each quantity over the events of a decade, and the number of events in which it is known.
void add_quantities(const std::vector<Decade>& population, int decade, int quantile, std::vector<Variable>& all) {
  std::size_t i = 0;
  for (const Description& about : results::population_quantities()) {
    const std::string name = "population_" + std::string(about.name);
    std::vector<double> values;
    for (const Decade& d : population) {
      const catalogue::Quantiles& q = d.spread[i].of;
      values.insert(values.end(), {q.low, q.median, q.high});
    }
    all.push_back({described(name, "quantiles over the events of a decade: " + std::string(about.long_name),
                             about.dimensional_unit, about.reference, results::unit_of(about)),
                   {decade, quantile},
                   values});
    all.push_back({described(name + "_events",
                             "number of events in which this is known: " + std::string(about.long_name), "", ""),
                   {decade},
                   each(population, [&](const Decade& d) { return d.spread[i].events; })});
    ++i;
  }
}

}  // namespace

std::vector<Variable> population_variables(netcdf::Writer& file, const std::vector<Decade>& population, int quantile) {
  constexpr std::string_view closed_form = "Eqs. 8-10";
  const auto line = catalogue::line_through(population);
  const int decade = file.dimension("decade", population.size()), ends = file.dimension("ends", 2),
            point = file.dimension("line_point", line.size());
  std::vector<Variable> all;
  all.push_back({described("decade", "rupture velocity in the middle of a decade", "c", closed_form),
                 {decade},
                 each(population, [](const Decade& d) { return d.middle; })});
  std::vector<double> bounds;
  for (const Decade& d : population) bounds.insert(bounds.end(), {d.low, d.high});
  all.push_back({described("decade_bounds", "ends of a decade; the upper end is excluded", "c", closed_form),
                 {decade, ends},
                 bounds});
  all.push_back({described("population_events", "number of events with a rupture velocity in this decade", "", ""),
                 {decade},
                 each(population, [](const Decade& d) { return d.events; })});
  all.push_back({described("population_closed_form_stress", "stress of the closed form in the middle of the decade",
                           "mu A / pi", closed_form),
                 {decade},
                 each(population, [](const Decade& d) { return d.stress; })});
  all.push_back({described("population_closed_form_slip_velocity",
                           "W(0) of the closed form in the middle of the decade", "c A / pi", closed_form),
                 {decade},
                 each(population, [](const Decade& d) { return d.slip_velocity; })});
  add_quantities(population, decade, quantile, all);
  using catalogue::LinePoint;
  all.push_back({described("line_rupture_velocity", "closed form: rupture velocity", "c", closed_form),
                 {point},
                 each(line, [](const LinePoint& p) { return p.rupture_velocity; })});
  all.push_back({described("line_stress", "closed form: stress", "mu A / pi", closed_form),
                 {point},
                 each(line, [](const LinePoint& p) { return p.stress; })});
  all.push_back({described("line_slip_velocity", "closed form: slip velocity W(0)", "c A / pi", closed_form),
                 {point},
                 each(line, [](const LinePoint& p) { return p.slip_velocity; })});
  return all;
}

}  // namespace slipfront::record::event_layout
