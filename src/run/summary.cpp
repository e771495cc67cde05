#include "run/summary.hpp"

#include <cmath>
#include <limits>

#include "foundation/math/constants.hpp"
#include "foundation/text/digits.hpp"
#include "output/further_scalars.hpp"
#include "record/pulses/pulse_variables.hpp"
#include "slipfront/setup/problem.hpp"

namespace slipfront::run {
namespace {

const output::Snapshot& last(const FinishedPulse& end) { return end.run.snapshots().back(); }
const output::Snapshot& last(const FinishedChain& end) { return end.run.snapshots().back(); }
const chain::Grid& grid(const FinishedChain& end) { return end.run.chain().problem().grid; }

/// C of f = C w; NaN for other laws.
double viscous_coefficient(const FinishedPulse& end) {
  return end.scenario.friction.linear_coefficient().value_or(std::numeric_limits<double>::quiet_NaN());
}

/// Adds rows for the further scalars of the last snapshot.
template <class End>
std::vector<SummaryItem<End>> with_further(std::vector<SummaryItem<End>> items) {
  for (const Description& about : output::further_scalars()) {
    const std::string unit = about.dimensional_unit.empty() ? "" : ", in " + std::string(about.dimensional_unit);
    items.push_back({std::string(about.name),
                     [name = about.name](const End& e) -> Value { return output::further_scalar(last(e), name); },
                     std::string(about.long_name) + unit});
  }
  return items;
}

/// Rows for settings, for x = 0 and for the peak.
std::vector<SummaryItem<FinishedPulse>> pulse_at_origin() {
  return {
      {"closure", [](const FinishedPulse& e) -> Value { return name_of(e.scenario.friction.closure()); },
       "how friction is averaged"},
      {"friction_coefficient", [](const FinishedPulse& e) -> Value { return viscous_coefficient(e); },
       "C of viscous friction"},
      {"damping_number", [](const FinishedPulse& e) -> Value { return viscous_coefficient(e) * last(e).time; },
       "Gamma = C t of viscous friction"},
      {"time", [](const FinishedPulse& e) -> Value { return last(e).time; }, "in b / (c A)"},
      {"slip_velocity_at_origin", [](const FinishedPulse& e) -> Value { return last(e).slip_velocity_at_origin; },
       "W at x = 0, in c A / pi"},
      {"stress_at_origin", [](const FinishedPulse& e) -> Value { return last(e).stress_at_origin; },
       "Sigma at x = 0, in mu A / pi"},
      {"slip_at_origin", [](const FinishedPulse& e) -> Value { return last(e).slip_at_origin; },
       "u at x = 0 since t = 0, in b / (2 pi)"},
      {"peak_slip_velocity", [](const FinishedPulse& e) -> Value { return last(e).peak_slip_velocity; },
       "largest W, in c A / pi"},
      {"peak_position", [](const FinishedPulse& e) -> Value { return last(e).peak_position; },
       "x of the peak, in b / A"},
  };
}

std::vector<SummaryItem<FinishedPulse>> pulse_fronts_and_energy() {
  return {
      {"trailing_front", [](const FinishedPulse& e) -> Value { return last(e).fronts.trailing; },
       "x of the fast front, the foot of the slip velocity, in b / A"},
      {"trailing_characteristic",
       [](const FinishedPulse& e) -> Value { return last(e).fronts.trailing_characteristic; },
       "x of the fast front as a characteristic, its position without friction"},
      {"leading_front", [](const FinishedPulse& e) -> Value { return last(e).fronts.leading; },
       "x of the slow front, in b / A"},
      {"trailing_front_observed", [](const FinishedPulse& e) -> Value { return last(e).fronts.trailing_observed; },
       "x of the fast front for an observer with a threshold"},
      {"leading_front_observed", [](const FinishedPulse& e) -> Value { return last(e).fronts.leading_observed; },
       "x of the slow front for an observer with a threshold"},
      {"energy_elastic", [](const FinishedPulse& e) -> Value { return last(e).energy.elastic; },
       "energy of the state at rest with the same density"},
      {"energy_kinetic", [](const FinishedPulse& e) -> Value { return last(e).energy.kinetic; },
       "energy less the elastic energy"},
      {"energy_dissipated", [](const FinishedPulse& e) -> Value { return last(e).energy.dissipated; },
       "energy lost to friction since t = 0"},
      {"energy_supplied", [](const FinishedPulse& e) -> Value { return last(e).energy.supplied; },
       "energy supplied by F since t = 0"},
      {"energy_through_ends", [](const FinishedPulse& e) -> Value { return last(e).energy.through_ends; },
       "energy that came in through the ends of the domain"},
      {"energy_shocks",
       [](const FinishedPulse& e) -> Value { return std::isnan(e.run.crossing_time()) ? none : last(e).energy.shocks; },
       "energy lost where trains run into each other",
       [](const FinishedPulse& e) -> std::string {
         if (e.run.problem().many_trains) return "trains pass through each other without loss";
         return "no trains have run into each other, and the rest of the balance, " + digits(last(e).energy.shocks, 2) +
                " in the units of the model, is the error of the cells";
       }},
  };
}

std::string no_crossing(const FinishedPulse& e) {
  return e.run.problem().many_trains ? "dislocations that overtake others form a train of their own"
                                     : "no dislocations have overtaken others";
}

/// Rows that describe the computation.
std::vector<SummaryItem<FinishedPulse>> pulse_solver() {
  return {
      {"first_crossing_time", [](const FinishedPulse& e) -> Value { return e.run.crossing_time(); },
       "time at which dislocations first overtake each other", no_crossing},
      {"first_crossing_position", [](const FinishedPulse& e) -> Value { return e.run.crossing_position(); },
       "x at which they do; averages are approximate behind it", no_crossing},
      {"conservation_error", [](const FinishedPulse& e) -> Value { return e.run.conservation_error(); },
       "relative error of the number of dislocations"},
      {"cells", [](const FinishedPulse& e) -> Value { return static_cast<long>(e.run.problem().cells); },
       "cells in the domain at t = 0; others come in and leave through its ends"},
      {"steps", [](const FinishedPulse& e) -> Value { return e.run.steps(); }, "number of time steps"},
      {"solve_seconds", [](const FinishedPulse& e) -> Value { return e.run.stepping_seconds(); },
       "seconds of the time steps only"},
      {"wall_seconds", [](const FinishedPulse& e) -> Value { return e.wall; }, "seconds of the whole command"},
  };
}

std::vector<SummaryItem<FinishedPulse>> pulse_items() {
  std::vector<SummaryItem<FinishedPulse>> items = pulse_at_origin();
  for (const auto& part : {pulse_fronts_and_energy(), pulse_solver()})
    items.insert(items.end(), part.begin(), part.end());
  return items;
}

double site_updates_per_second(const FinishedChain& end) {
  const double updates = static_cast<double>(grid(end).sites) * static_cast<double>(end.steps);
  return end.stepping > 0 ? updates / end.stepping : 0;
}

/// Settings, values at x = 0 and at the peak, and fronts.
std::vector<SummaryItem<FinishedChain>> chain_at_origin() {
  return {
      {"time", [](const FinishedChain& e) -> Value { return last(e).time; }, "in b / (c A)"},
      {"scale", [](const FinishedChain& e) -> Value { return e.run.scale(); },
       "factor by which x and t are multiplied and friction is divided"},
      {"slip_at_origin", [](const FinishedChain& e) -> Value { return last(e).slip_at_origin; },
       "u at x = 0 since t = 0 over the scale, in b / (2 pi)"},
      {"slip_velocity_at_origin", [](const FinishedChain& e) -> Value { return last(e).slip_velocity_at_origin; },
       "weighted mean of u_t, in c A / pi"},
      {"stress_at_origin", [](const FinishedChain& e) -> Value { return last(e).stress_at_origin; },
       "weighted mean of -u_x, in mu A / pi"},
      {"window", [](const FinishedChain& e) -> Value { return e.run.window(); },
       "width of the average of the slip at x = 0, in b / A"},
      {"smooth_window", [](const FinishedChain& e) -> Value { return e.averages.width; },
       "width of the averages of velocity and stress at x = 0, in b / A"},
      {"peak_slip_velocity", [](const FinishedChain& e) -> Value { return last(e).peak_slip_velocity; },
       "largest W of the profile, in c A / pi"},
      {"peak_position", [](const FinishedChain& e) -> Value { return last(e).peak_position; },
       "x of the peak, in b / A"},
      {"leading_front", [](const FinishedChain& e) -> Value { return last(e).fronts.leading; },
       "x of the last dislocation, in b / A"},
      {"trailing_front_observed", [](const FinishedChain& e) -> Value { return last(e).fronts.trailing_observed; },
       "x of the fast front for an observer with a threshold"},
      {"leading_front_observed", [](const FinishedChain& e) -> Value { return last(e).fronts.leading_observed; },
       "x of the slow front for an observer with a threshold"},
  };
}

/// Dislocations, checks, and how the chain was computed.
std::vector<SummaryItem<FinishedChain>> chain_solver() {
  return {
      {"dislocations", [](const FinishedChain& e) -> Value { return e.balance.dislocations; },
       "number of dislocations at the end"},
      {"energy_phonons", [](const FinishedChain& e) -> Value { return last(e).energy.phonons; },
       "energy less that of uniform trains with the same averages",
       [](const FinishedChain&) -> std::string {
         return "the surface is smooth (interface.contact = 0), and there are no trains without a substrate";
       }},
      {"energy_drift", [](const FinishedChain& e) -> Value { return e.balance.energy_drift; },
       "relative error of the balance of energy and work since t = 0"},
      {"charge_error", [](const FinishedChain& e) -> Value { return e.balance.charge_error; },
       "dislocations that left through the ends; 0 if these are fixed or periodic"},
      {"sites", [](const FinishedChain& e) -> Value { return static_cast<long>(grid(e).sites); }, "number of sites"},
      {"spacing", [](const FinishedChain& e) -> Value { return grid(e).spacing; },
       "spacing of the sites, in the chain's own x"},
      {"steps", [](const FinishedChain& e) -> Value { return e.run.chain().steps(); }, "number of time steps"},
      {"ranks", [](const FinishedChain& e) -> Value { return static_cast<long>(e.ranks); }, "number of processes"},
      {"threads", [](const FinishedChain& e) -> Value { return static_cast<long>(e.threads); }, "threads of each rank"},
      {"site_updates_per_second", [](const FinishedChain& e) -> Value { return site_updates_per_second(e); },
       "site updates per second, including output"},
      {"wall_seconds", [](const FinishedChain& e) -> Value { return e.wall; }, "seconds of the whole command"},
  };
}

/// A number of the series of events; NaN where no spring loads the chain.
SummaryItem<FinishedChain> of_events(const char* key, double (*number)(const output::EventSeries&),
                                     const char* meaning) {
  return {key,
          [number](const FinishedChain& e) -> Value {
            if (!e.run.chain().problem().loading.acts()) return std::numeric_limits<double>::quiet_NaN();
            return number(output::series_of(e.run.events()));
          },
          meaning};
}

std::vector<SummaryItem<FinishedChain>> chain_events() {
  using output::EventSeries;
  return {
      of_events(
          "event_count", [](const EventSeries& e) { return static_cast<double>(e.count); }, "number of slip events"),
      of_events(
          "event_recurrence_time", [](const EventSeries& e) { return e.recurrence_time; },
          "median time between onsets of slip events, in b / (c A)"),
      of_events(
          "event_median_stress_drop", [](const EventSeries& e) { return e.stress_drop; },
          "median stress drop of slip events"),
      of_events(
          "event_median_peak_velocity", [](const EventSeries& e) { return e.peak_velocity; },
          "median peak velocity of slip events, in c A / pi"),
  };
}

std::vector<SummaryItem<FinishedChain>> chain_items() {
  std::vector<SummaryItem<FinishedChain>> items = chain_at_origin();
  for (const auto& part : {chain_events(), chain_solver()}) items.insert(items.end(), part.begin(), part.end());
  return items;
}

}  // namespace

std::string_view unit_of(std::string_view key) {
  for (const record::ScalarVariable& scalar : record::scalar_variables())
    if (scalar.about.name == key) return scalar.about.dimensional_unit;
  if (key == "time" || key == "first_crossing_time" || key == "event_recurrence_time") return "b / (c A)";
  if (key == "event_median_peak_velocity") return "c A / pi";
  if (key == "first_crossing_position" || key == "window" || key == "smooth_window") return "b / A";
  return {};
}

std::string_view unit_of(const SummaryValue& row) { return row.unit.empty() ? unit_of(row.key) : row.unit; }

std::string without_unit(std::string_view key, const std::string& meaning) {
  const std::string ending = "in " + std::string(unit_of(key));
  if (unit_of(key).empty() || !meaning.ends_with(ending)) return meaning;
  const std::string words = meaning.substr(0, meaning.size() - ending.size());
  return words.ends_with(", ") ? words.substr(0, words.size() - 2) : words;
}

SummaryValue in_si(const SummaryValue& row, const medium::SiUnits& units, double* error) {
  SummaryValue converted = row;
  double* const value = std::get_if<double>(&converted.value);
  if (!value || unit_of(row).empty()) return converted;
  const medium::UnitInSi unit = units.of(unit_of(row));
  *value *= unit.value;
  if (error) *error *= unit.value;
  const std::string words = without_unit(row.key, row.meaning);
  converted.meaning =
      words + (words.empty() ? "" : ", ") + (unit.between_faces ? "between the faces, " : "") + "in " + unit.name;
  return converted;
}

std::span<const SummaryItem<FinishedPulse>> pulse_summary() {
  static const std::vector<SummaryItem<FinishedPulse>> items = with_further(pulse_items());
  return items;
}
std::span<const SummaryItem<FinishedChain>> chain_summary() {
  static const std::vector<SummaryItem<FinishedChain>> items = with_further(chain_items());
  return items;
}

}  // namespace slipfront::run
