#include "events/results/columns.hpp"

#include <limits>
#include <utility>

#include "math/constants.hpp"
#include "math/digits.hpp"

namespace slipfront::results {

using inference::answer_quantities;
using inference::bound_quantities;
using inference::Inferred;
using inference::Quantity;

std::span<const EventNumber> event_numbers() {
  static constexpr EventNumber numbers[] = {
      {{"c_m_s", "speed of strain waves, in m/s", "", "Eq. 3", {}, {}, "m s-1"},
       false,
       [](const EventResult& r) { return r.estimate ? std::optional(r.estimate->speed) : std::nullopt; }},
      {{"rupture_velocity_m_s", "observed rupture velocity, in m/s", "", "Section 4", {}, {}, "m s-1"},
       true,
       [](const EventResult& r) { return r.estimate ? r.estimate->observed_rupture_velocity_m_s : std::nullopt; }},
      {{"slip_velocity_m_s", "observed slip velocity, in m/s", "", "Section 4", {}, {}, "m s-1"},
       true,
       [](const EventResult& r) { return r.estimate ? r.estimate->observed_slip_velocity_m_s : std::nullopt; }},
  };
  return numbers;
}

std::optional<Inferred> answer_of(const EventResult& result, const Quantity& quantity) {
  return result.estimate ? (*result.estimate).*quantity.inferred : std::nullopt;
}

std::vector<Description> population_quantities() {
  std::vector<Description> all;
  for (const EventNumber& number : event_numbers())
    if (number.in_population) all.push_back(number.about);
  for (const auto quantities : {answer_quantities(), bound_quantities()})
    for (const Quantity& q : quantities) all.push_back(q.about);
  return all;
}

std::optional<catalogue::Member> member_of(const EventResult& result) {
  constexpr double none = std::numeric_limits<double>::quiet_NaN();
  if (!result.estimate || !result.estimate->rupture_velocity) return {};
  catalogue::Member m{result.estimate->rupture_velocity->value, {}};
  for (const EventNumber& number : event_numbers())
    if (number.in_population) m.values.push_back(number.get(result).value_or(none));
  for (const auto quantities : {answer_quantities(), bound_quantities()})
    for (const Quantity& q : quantities) {
      const auto x = answer_of(result, q);
      m.values.push_back(x ? x->value : none);
    }
  return m;
}

using catalogue::Quantiles;
using finite_fault::pulse_quantities;
using finite_fault::PulseQuantity;
using inference::answer_quantities;
using inference::bound_quantities;
using inference::Interval;
using inference::Posterior;
using inference::posterior_quantities;
using inference::quantities;
using inference::Quantity;

namespace {

template <class Get>
NumberColumn column(const Description& about, std::string name, const std::string& of, Axis axis, std::size_t count,
                    Get&& get) {
  return {std::move(name), of + std::string(about.long_name),
          unit_of(about),  about.dimensional_unit,
          about.reference, axis,
          count,           std::forward<Get>(get)};
}

template <class Get>
NumberColumn column(const Description& about, Get&& get) {
  return column(about, std::string(about.name), "", Axis::none, 1, std::forward<Get>(get));
}

void add_answer(std::vector<NumberColumn>& all, const Quantity& q) {
  all.push_back(column(q.about, [&q](const EventResult& r, double* out) {
    const auto x = answer_of(r, q);
    *out = x ? x->value : none;
  }));
  all.push_back(column(q.about, std::string(q.about.name) + "_interval", "5 % and 95 % of: ", Axis::bound, 2,
                       [&q](const EventResult& r, double* out) {
                         const auto x = answer_of(r, q);
                         const Interval i = x && x->interval ? *x->interval : Interval{none, none};
                         out[0] = i.low;
                         out[1] = i.high;
                       }));
}

void add_estimates(std::vector<NumberColumn>& all) {
  for (const EventNumber& number : event_numbers())
    all.push_back(
        column(number.about, [get = number.get](const EventResult& r, double* out) { *out = get(r).value_or(none); }));
  for (const auto quantities : {answer_quantities(), bound_quantities()})
    for (const Quantity& q : quantities) add_answer(all, q);
}

void add_prior_share(std::vector<NumberColumn>& all, const Description& about,
                     std::optional<double> Posterior::*share) {
  all.push_back(column(about, [share](const EventResult& r, double* out) {
    *out = r.posterior ? ((*r.posterior).*share).value_or(none) : none;
  }));
}

void add_posterior(std::vector<NumberColumn>& all) {
  for (const Quantity& q : posterior_quantities())
    all.push_back(column(q.about, "posterior_" + std::string(q.about.name),
                         "with friction and errors: ", Axis::quantile, 3, [&q](const EventResult& r, double* out) {
                           const auto x = r.posterior ? (*r.posterior).*q.quantiles : std::nullopt;
                           const Quantiles found = x.value_or(Quantiles{none, none, none});
                           out[0] = found.low;
                           out[1] = found.median;
                           out[2] = found.high;
                         }));
  add_prior_share(all,
                  {"contact_ratio_prior_share",
                   "width of the interval of ln A over that of its prior; near 1 the data say nothing", "", ""},
                  &Posterior::contact_ratio_prior_share);
  add_prior_share(all,
                  {"damping_number_prior_share",
                   "width of the interval of ln(1 + C T) over that of its prior; near 1 the data say nothing", "", ""},
                  &Posterior::damping_number_prior_share);
  all.push_back(
      column({"effective_samples", "effective number of samples", "", ""},
             [](const EventResult& r, double* out) { *out = r.posterior ? r.posterior->effective_samples : none; }));
  all.push_back(column({"pareto_k", "shape of the tail of the weights: above 0.7 no intervals", "", ""},
                       [](const EventResult& r, double* out) { *out = r.posterior ? r.posterior->pareto_k : none; }));
  all.push_back(column({"samples", "samples of the state of the fault", "", ""}, [](const EventResult& r, double* out) {
    *out = r.posterior ? static_cast<double>(r.posterior->samples) : none;
  }));
  all.push_back(column({"friction_identified", "1 where the data say what the friction is, else 0", "", ""},
                       [](const EventResult& r, double* out) {
                         *out = r.posterior ? (r.posterior->friction_identified ? 1 : 0) : none;
                       }));
}

void add_draws(std::vector<NumberColumn>& all, std::size_t draws) {
  for (const Quantity& q : quantities())
    all.push_back(column(q.about, "draw_" + std::string(q.about.name), "drawn from the posterior: ", Axis::draw, draws,
                         [value = q.state, draws](const EventResult& r, double* out) {
                           for (std::size_t i = 0; i < draws; ++i)
                             out[i] =
                                 r.posterior && i < r.posterior->draws.size() ? r.posterior->draws[i].*value : none;
                         }));
}

}  // namespace

std::string_view unit_of(const Description& about) { return about.si_unit.empty() ? "1" : about.si_unit; }

std::vector<NumberColumn> number_columns(const ColumnChoice& choice) {
  std::vector<NumberColumn> all;
  add_estimates(all);
  add_posterior(all);
  all.push_back(column({"line", "line of the event in its file", "", ""},
                       [](const EventResult& r, double* out) { *out = static_cast<double>(r.observation.line); }));
  if (choice.draws > 0) add_draws(all, choice.draws);
  if (!choice.pulse) return all;
  for (const PulseQuantity& q : pulse_quantities())
    all.push_back(column(q.about, [get = q.get](const EventResult& r, double* out) {
      *out = r.pulse && r.pulse->reason.empty() ? get(*r.pulse).value_or(none) : none;
    }));
  return all;
}

std::vector<TextColumn> text_columns(bool with_pulse) {
  std::vector<TextColumn> all = {
      {"name", "name of the event", [](const EventResult& r) { return r.observation.name; }},
      {"date", "date as its source gives it", [](const EventResult& r) { return r.observation.date; }},
      {"kind", "kind of event", [](const EventResult& r) { return r.observation.kind; }},
      {"citation", "source of the observation", [](const EventResult& r) { return r.observation.citation; }},
      {"note", "what the source says to mind", [](const EventResult& r) { return r.observation.note; }},
      {"file", "where the event was read", [](const EventResult& r) { return r.observation.file; }},
      {"rupture_velocity_is", "whether the rupture velocity is that of the observed front or |V-|",
       [](const EventResult& r) { return std::string(name_of(r.observation.rupture_velocity_is)); }},
      {"stress_drop_is", "whether the stress drop is static or all the stress that was stored",
       [](const EventResult& r) { return std::string(name_of(r.observation.stress_drop_is)); }},
      {"tension", "observations that disagree with the others, with the number of standard deviations",
       [](const EventResult& r) { return tension_text(r); }},
      {"warnings", "what was assumed, left out or not identifiable",
       [](const EventResult& r) { return joined(r.warnings()); }},
      {"error", "why there is no result", [](const EventResult& r) { return r.error; }},
  };
  if (with_pulse)
    all.push_back({"pulse_reason", "why there is no pulse",
                   [](const EventResult& r) { return r.pulse ? r.pulse->reason : std::string(); }});
  return all;
}

std::string tension_text(const EventResult& result) {
  std::vector<std::string> parts;
  if (result.posterior)
    for (const auto& t : result.posterior->tension)
      parts.push_back(t.observation + (t.sigmas ? " " + digits(*t.sigmas, 3) : ""));
  return joined(parts);
}

std::string joined(const std::vector<std::string>& parts) {
  std::string out;
  for (const std::string& part : parts) out += (out.empty() ? "" : "; ") + part;
  return out;
}

}  // namespace slipfront::results
