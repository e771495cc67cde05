#include "results/quantities.hpp"

#include <limits>

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

}  // namespace slipfront::results
