#include <fmt/format.h>

#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "event_output.hpp"

namespace {

using namespace slipfront;
using inference::Inferred;
using results::EventResult;

using ReportNumber = std::string (*)(double);

std::string four_digits(double x) { return fmt::format("{:.4g}", x); }

std::string pascals(double x) {
  for (const auto& [unit, name] : {std::pair{1e9, "GPa"}, {1e6, "MPa"}, {1e3, "kPa"}})
    if (x >= unit) return fmt::format("{:.4g} {}", x / unit, name);
  return fmt::format("{:.4g} Pa", x);
}

/// A number with its interval: "163.6 MPa (35.93 MPa to 314.5 MPa)".
std::string with_interval(const Inferred& x, ReportNumber text = four_digits) {
  if (!x.interval) return text(x.value);
  return fmt::format("{} ({} to {})", text(x.value), text(x.interval->low), text(x.interval->high));
}

/// The number by the closed form, if the result is another one.
std::string by_closed_form(const std::optional<double>& x, double result, ReportNumber text) {
  if (!x || text(*x) == text(result)) return {};
  return fmt::format(" The closed form, which has no friction, gives {}.", text(*x));
}

std::string observations_of(const EventResult& result) {
  const inference::Estimate& e = *result.estimate;
  std::vector<std::string> all;
  if (e.observed_rupture_velocity_m_s) all.push_back("rupture velocity " + front_text(e.observed_rupture_velocity_m_s));
  if (e.observed_slip_velocity_m_s) all.push_back("slip velocity " + speed_text(e.observed_slip_velocity_m_s));
  if (const auto& drop = result.observation.stress_drop) all.push_back("stress drop " + pascals(drop->middle()));
  if (const auto A = result.observation.contact_ratio) all.push_back("contact ratio " + four_digits(*A));
  return all.empty() ? "" : fmt::format("Observed: {}.", fmt::join(all, ", "));
}

/// The quantity as a sentence. Empty if it is unknown.
std::string sentence(std::string_view about, const std::optional<Inferred>& value, const std::optional<Inferred>& bound,
                     const std::optional<double>& closed_form, ReportNumber text) {
  if (bound)
    return fmt::format("{} is at least {}: that is its value without friction.", about, with_interval(*bound, text));
  if (!value) return {};
  return fmt::format("{} is {}.", about, with_interval(*value, text)) + by_closed_form(closed_form, value->value, text);
}

std::string rupture_velocity_of(const inference::Estimate& e) {
  if (!e.rupture_velocity) return {};
  return fmt::format("The rupture velocity over c is {}, where c = {} is the speed of strain waves on the interface.",
                     with_interval(*e.rupture_velocity), speed_text(e.speed));
}

std::string friction_of(const inference::Estimate& e) {
  std::string text;
  if (e.frictionless_slip_velocity)
    text += fmt::format("Without friction the slip velocity would be {} c A / pi.",
                        with_interval(*e.frictionless_slip_velocity));
  if (e.slip_velocity_ratio)
    text += fmt::format(" Friction leaves a share of {} of it.", with_interval(*e.slip_velocity_ratio));
  if (e.damping_number) text += fmt::format(" The damping number C T is {}.", with_interval(*e.damping_number));
  return text;
}

std::string pulse_of(const finite_fault::FaultPulse& p) {
  if (!p.reason.empty()) return "There is no pulse: " + p.reason + ".";
  const auto number = [](const std::optional<double>& x) { return x ? fmt::format("{:.3g}", *x) : std::string("-"); };
  std::string text = fmt::format(
      "Pulse: without friction, a pulse through this slip distribution has {} times the front velocity of the model, "
      "and reaches {} of {} columns by {:.3g} s. The correlation of both slips is {}.",
      number(p.front_velocity_ratio), p.reached, p.x.size(), p.end, number(p.correlation_of_slip));
  if (p.contact_ratio)
    text += fmt::format(
        " It slips as much as the model if A is {}. This A differs from that of the event: it is for the amount of "
        "slip, without friction; that of the event is for the slip velocity.",
        number(p.contact_ratio));
  return text;
}

std::string basis_of(const EventResult& result) {
  const bool is_sampled = result.posterior && result.posterior->suffices;
  return (is_sampled ? fmt::format("Each number is the median of {} states of the fault that agree with the "
                                   "observations, and need not equal the observed value. Its interval holds 90 % of "
                                   "them.",
                                   result.posterior->samples)
                     : std::string("The numbers are closed forms, at the middle of each observation.")) +
         " They rest on viscous friction, and on a step of stress that runs into an unstressed interface.";
}

}  // namespace

std::string event_report(const EventResult& result) {
  if (!result.estimate) return {};
  const inference::Estimate& e = *result.estimate;
  const bool observed_A = result.observation.contact_ratio.has_value();
  std::string text = fitted(result.observation.name) + "\n";
  for (const std::string& line : {observations_of(result),
                                  sentence("The shear stress before the rupture", e.stress_pa, e.stress_pa_bound,
                                           result.frictionless.stress_pa, pascals),
                                  sentence("In units of mu A / pi it", e.stress, e.stress_bound, {}, four_digits),
                                  sentence("The contact ratio A", e.contact_ratio, e.contact_ratio_bound,
                                           observed_A ? std::nullopt : result.frictionless.contact_ratio, four_digits),
                                  rupture_velocity_of(e), friction_of(e),
                                  result.pulse ? pulse_of(*result.pulse) : std::string(), basis_of(result)})
    if (!line.empty()) text += fitted(line, 2);
  return text;
}
