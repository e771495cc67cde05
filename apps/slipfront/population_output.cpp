#include "population_output.hpp"

#include <fmt/format.h>

#include <array>
#include <stdexcept>
#include <string_view>

#include "event_output.hpp"
#include "events/results/columns.hpp"
#include "json.hpp"
#include "terminal_table.hpp"

using namespace slipfront::catalogue;
using namespace slipfront::results;

namespace {

/// The spread of the quantity with this name.
const Spread& spread_of(const Decade& decade, std::string_view name) {
  const auto quantities = population_quantities();
  for (std::size_t i = 0; i < quantities.size(); ++i)
    if (quantities[i].name == name) return decade.spread[i];
  throw std::logic_error("no such quantity of a population");
}

/// Text "median (5 % to 95 %)" in `unit`. For one event it is only the value.
std::string spread_text(const Spread& s, double unit = 1) {
  if (s.events == 0) return "-";
  const auto text = [unit](double value) { return fmt::format("{:.3g}", value / unit); };
  if (s.events == 1) return text(s.of.median);
  return fmt::format("{} ({} to {})", text(s.of.median), text(s.of.low), text(s.of.high));
}

/// Text of the spread of velocities in m/s, in a unit that suits the median.
std::string velocities_text(const Spread& s) {
  if (s.events == 0) return "-";
  if (s.of.median >= 1e-3) return spread_text(s) + " m/s";
  if (s.of.median >= 1e-6) return spread_text(s, 1e-3) + " mm/s";
  return spread_text(s, 1e-3 / 86400) + " mm/day";
}

/// Text of stresses in MPa: the known values, and the lower bounds after ">=".
std::string stress_text(const Spread& known, const Spread& bound) {
  if (bound.events == 0) return spread_text(known, 1e6);
  return (known.events > 0 ? spread_text(known, 1e6) + ", " : "") + ">= " + spread_text(bound, 1e6);
}

constexpr std::array<TableColumn, 8> population_columns = {
    {{13, true}, {7}, {16}, {11}, {24, true, 2}, {35, true}, {32, true}, {0, true}}};

}  // namespace

std::string population_json(const std::vector<Decade>& decades) {
  Json all = Json::array();
  for (const Decade& d : decades) {
    Json j;
    j["rupture_velocity_from"] = d.low;
    j["rupture_velocity_to"] = d.high;
    j["events"] = d.events;
    j["closed_form"] = {
        {"rupture_velocity", d.middle}, {"stress", d.stress}, {"frictionless_slip_velocity", d.slip_velocity}};
    std::size_t i = 0;
    for (const auto& about : population_quantities()) {
      const Spread& s = d.spread[i++];
      const std::string name(about.name);
      j[name] = s.events > 0 ? Json(s.of.median) : Json();
      j[name + "_interval"] = s.events > 0 ? Json{s.of.low, s.of.high} : Json();
      j[name + "_events"] = s.events;
    }
    all.push_back(j);
  }
  return text_of(all);
}

std::string population_csv(const std::vector<Decade>& decades) {
  std::string text =
      "rupture_velocity_from,rupture_velocity_to,events,closed_form_rupture_velocity,closed_form_stress,"
      "closed_form_frictionless_slip_velocity";
  for (const auto& about : population_quantities()) text += fmt::format(",{0},{0}_low,{0}_high,{0}_events", about.name);
  text += "\n";
  for (const Decade& d : decades) {
    text += fmt::format("{},{},{},{},{},{}", d.low, d.high, d.events, d.middle, d.stress, d.slip_velocity);
    for (const Spread& s : d.spread)
      text += s.events > 0 ? fmt::format(",{},{},{},{}", s.of.median, s.of.low, s.of.high, s.events) : ",,,,0";
    text += "\n";
  }
  return text;
}

std::string population_table(const std::vector<Decade>& decades, std::size_t events, std::size_t errors) {
  std::size_t binned = 0;
  for (const Decade& d : decades) binned += d.events;
  const std::string about = fmt::format(
      "{} of {} events have a rupture velocity{}. Medians (5 % to 95 %) are over the events of a decade. "
      "The closed form is that in the middle of the decade.",
      binned, events, errors > 0 ? fmt::format(" ({} refused)", errors) : "");
  TerminalTable table(population_columns);
  table.add({"", "", "rupture", "stress by"});
  table.add({"V / c", "events", "velocity", "closed form", "stress, mu A / pi", "slip velocity", "contact ratio A",
             "stress, MPa"});
  for (const Decade& d : decades)
    table.add({fmt::format("1e{} ... 1e{}", d.exponent, d.exponent + 1), fmt::format("{}", d.events),
               d.events > 0 ? front_text(spread_of(d, "rupture_velocity_m_s").of.median) : "-",
               fmt::format("{:.3g}", d.stress), spread_text(spread_of(d, "stress")),
               velocities_text(spread_of(d, "slip_velocity_m_s")), spread_text(spread_of(d, "contact_ratio")),
               stress_text(spread_of(d, "stress_pa"), spread_of(d, "stress_pa_bound"))});
  return fitted(about) + "\n" + table.text();
}
