#include <fmt/format.h>

#include <array>
#include <string_view>

#include "event_output.hpp"

namespace {

using slipfront::finite_fault::FaultPulse;
using slipfront::inference::Estimate;
using slipfront::inference::Inferred;
using slipfront::results::EventResult;

constexpr const char* table_layout = "{} {:>12} {:>9} {:>9} {:>12} {:>12} {:>12} {:>11} {:>9} {:>9}\n";
constexpr std::size_t name_width = 34;

/// The first `width` characters (code points) of a UTF-8 text, padded with blanks.
std::string clipped(const std::string& text, std::size_t width) {
  std::string out;
  std::size_t count = 0;
  for (const char c : text) {
    const auto byte = static_cast<unsigned char>(c);
    const bool starts = (byte & 0xC0u) != 0x80u;
    if (starts && count == width) break;
    if (starts) ++count;
    out += byte < 0x20 ? ' ' : c;
  }
  return out + std::string(width - count, ' ');
}

using Cells = std::array<std::string, 10>;

std::string line_of(const Cells& cells) {
  return fmt::format(table_layout, clipped(cells[0], name_width), cells[1], cells[2], cells[3], cells[4], cells[5],
                     cells[6], cells[7], cells[8], cells[9]);
}

/// An inferred quantity and its column. If only a lower bound is known, the column shows `bound`.
struct Column {
  std::size_t cell;
  std::optional<Inferred> Estimate::*value;
  double unit = 1;
  int digits = 4;
  std::optional<Inferred> Estimate::*bound = nullptr;

  bool is_bound(const Estimate& e) const { return bound && e.*bound; }
  const std::optional<Inferred>& of(const Estimate& e) const { return is_bound(e) ? e.*bound : e.*value; }
};
constexpr std::array<Column, 7> columns = {{{2, &Estimate::rupture_velocity},
                                            {3, &Estimate::stress, 1, 4, &Estimate::stress_bound},
                                            {5, &Estimate::frictionless_slip_velocity},
                                            {6, &Estimate::slip_velocity_ratio},
                                            {7, &Estimate::contact_ratio, 1, 3, &Estimate::contact_ratio_bound},
                                            {8, &Estimate::stress_pa, 1e6, 4, &Estimate::stress_pa_bound},
                                            {9, &Estimate::damping_number, 1, 3}}};

/// A line with one end of each interval, printed below the values. Empty if there are no intervals.
std::string interval_line(const Estimate& e, const char* label, double slipfront::inference::Interval::*end) {
  Cells cells;
  cells[0] = fmt::format("{:>{}}", label, name_width);
  bool any = false;
  for (const Column& c : columns) {
    const auto& x = c.of(e);
    if (!x || !x->interval) continue;
    cells[c.cell] = fmt::format("{:.{}g}", (*x->interval).*end / c.unit, c.digits);
    any = true;
  }
  if (!any) return {};
  const std::string line = line_of(cells);
  return line.substr(0, line.find_last_not_of(" \n") + 1) + "\n";
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

std::string event_table_head() {
  return line_of({"", "rupture", "", "stress", "slip", "frictionless", "observed /", "contact", "stress", "damping"}) +
         line_of({"event", "velocity", "V / c", "mu A / pi", "velocity", "c A / pi", "frictionless", "ratio A", "MPa",
                  "C T"});
}

std::string event_table_row(const EventResult& result) {
  if (!result.estimate) return clipped(result.observation.name, name_width) + " error: " + result.error + "\n";
  const Estimate& e = *result.estimate;
  Cells cells;
  cells[0] = result.observation.name;
  cells[1] = front_text(e.observed_rupture_velocity_m_s);
  cells[4] = speed_text(e.observed_slip_velocity_m_s);
  for (const Column& c : columns) {
    const auto& x = c.of(e);
    cells[c.cell] = x ? fmt::format("{}{:.{}g}", c.is_bound(e) ? ">=" : "", x->value / c.unit, c.digits) : "-";
  }
  return line_of(cells) + interval_line(e, "5 %", &slipfront::inference::Interval::low) +
         interval_line(e, "95 %", &slipfront::inference::Interval::high);
}

std::string event_pulse_lines(const EventResult& result) {
  if (!result.pulse) return {};
  const FaultPulse& p = *result.pulse;
  if (!p.reason.empty()) return "  no pulse: " + p.reason + "\n";
  const auto number = [](const std::optional<double>& x) { return x ? fmt::format("{:.3g}", *x) : std::string("-"); };
  return fmt::format("  pulse: front velocity over the model's {}; {} of {} columns reached by {:.3g} s\n",
                     number(p.front_velocity_ratio), p.reached, p.x.size(), p.end) +
         fmt::format("         correlation of slip {}; contact ratio A by its size {}\n", number(p.correlation_of_slip),
                     number(p.contact_ratio));
}
