#include <fmt/format.h>

#include <array>
#include <string_view>
#include <utility>
#include <vector>

#include "event_output.hpp"

namespace {

using slipfront::finite_fault::FaultPulse;
using EventEstimate = slipfront::inference::Estimate;
using slipfront::inference::Inferred;
using slipfront::results::EventResult;

constexpr std::size_t name_width = 32;
constexpr std::array<TableColumn, 10> event_columns = {
    {{name_width, true}, {12}, {12}, {9}, {11}, {9}, {9}, {9}, {9}, {8}}};

/// The name of an event. Of a longer one only the first `name_width` characters.
std::string name_cell(const std::string& name) {
  std::string cell = name.substr(0, after_characters(name, name_width));
  for (char& c : cell)
    if (static_cast<unsigned char>(c) < 0x20) c = ' ';
  return cell;
}

/// An inferred quantity and its column. If only a lower bound is known, the column shows `bound`.
struct InferredColumn {
  std::size_t cell;
  std::optional<Inferred> EventEstimate::*value;
  double unit = 1;
  int digits = 4;
  std::optional<Inferred> EventEstimate::*bound = nullptr;

  bool is_bound(const EventEstimate& e) const { return bound && e.*bound; }
  const std::optional<Inferred>& of(const EventEstimate& e) const { return is_bound(e) ? e.*bound : e.*value; }
};
constexpr std::array<InferredColumn, 7> inferred_columns = {
    {{3, &EventEstimate::stress_pa, 1e6, 4, &EventEstimate::stress_pa_bound},
     {4, &EventEstimate::contact_ratio, 1, 3, &EventEstimate::contact_ratio_bound},
     {5, &EventEstimate::rupture_velocity},
     {6, &EventEstimate::stress, 1, 4, &EventEstimate::stress_bound},
     {7, &EventEstimate::frictionless_slip_velocity},
     {8, &EventEstimate::slip_velocity_ratio},
     {9, &EventEstimate::damping_number, 1, 3}}};

/// Adds a line with one end of each interval below the values, if there are intervals.
void add_interval_line(TerminalTable& table, const EventEstimate& e, const char* label,
                       double slipfront::inference::Interval::*end) {
  std::vector<std::string> cells = {label};
  for (const InferredColumn& c : inferred_columns) {
    const auto& x = c.of(e);
    if (!x || !x->interval) continue;
    cells.resize(c.cell);
    cells.push_back(fmt::format("{:.{}g}", (*x->interval).*end / c.unit, c.digits));
  }
  if (cells.size() > 1) table.add(std::move(cells), TerminalTable::Label::right);
}

}  // namespace

std::string speed_text(const std::optional<double>& v) {
  if (!v) return "-";
  if (*v >= 100) return fmt::format("{:.3g} km/s", *v / 1e3);
  if (*v >= 1e-3) return fmt::format("{:.3g} m/s", *v);
  return fmt::format("{:.3g} mm/day", *v * 86400e3);
}

std::string front_text(const std::optional<double>& v) {
  return v && *v < 1 ? fmt::format("{:.3g} km/day", *v * 86.4) : speed_text(v);
}

TerminalTable event_table_head() {
  TerminalTable table(event_columns);
  table.add({"", "observed", "observed", "", "", "", "", "slip vel.", "share"});
  table.add({"", "rupture", "slip", "stress", "contact", "", "stress", "without", "friction", "damping"});
  table.add({"event", "velocity", "velocity", "MPa", "ratio A", "V / c", "mu A / pi", "c A / pi", "leaves", "C T"});
  return table;
}

TerminalTable event_table_row(const EventResult& result) {
  TerminalTable table(event_columns);
  std::string name = name_cell(result.observation.name);
  if (!result.estimate) {
    table.add_note(name + ": error: " + result.error);
    return table;
  }
  const EventEstimate& e = *result.estimate;
  std::vector<std::string> cells(event_columns.size());
  cells[0] = std::move(name);
  cells[1] = front_text(e.observed_rupture_velocity_m_s);
  cells[2] = speed_text(e.observed_slip_velocity_m_s);
  for (const InferredColumn& c : inferred_columns) {
    const auto& x = c.of(e);
    cells[c.cell] = x ? fmt::format("{}{:.{}g}", c.is_bound(e) ? ">=" : "", x->value / c.unit, c.digits) : "-";
  }
  table.add(std::move(cells));
  add_interval_line(table, e, "5 %", &slipfront::inference::Interval::low);
  add_interval_line(table, e, "95 %", &slipfront::inference::Interval::high);
  return table;
}

void add_event_pulse(TerminalTable& table, const EventResult& result) {
  if (!result.pulse) return;
  const FaultPulse& p = *result.pulse;
  if (!p.reason.empty()) {
    table.add_note("  no pulse: " + p.reason);
    return;
  }
  const auto number = [](const std::optional<double>& x) { return x ? fmt::format("{:.3g}", *x) : std::string("-"); };
  table.add_note(fmt::format("  pulse: front velocity over the model's {}; {} of {} columns reached by {:.3g} s",
                             number(p.front_velocity_ratio), p.reached, p.x.size(), p.end));
  table.add_note(fmt::format("         correlation of slip {}; contact ratio A by the amount of slip {}",
                             number(p.correlation_of_slip), number(p.contact_ratio)));
}
