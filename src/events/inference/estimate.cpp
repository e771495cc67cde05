#include "slipfront/events/inference/estimate.hpp"

#include <cmath>
#include <limits>
#include <stdexcept>
#include <utility>

#include "events/inference/sampling/proposal.hpp"
#include "math/digits.hpp"
#include "slipfront/theory/medium/constants.hpp"
#include "slipfront/theory/medium/medium.hpp"
#include "slipfront/theory/rupture/relations.hpp"

namespace slipfront::inference {

using catalogue::MeasuredValue;
using catalogue::Observation;
using catalogue::RuptureVelocityIs;
using catalogue::SlipVelocityKind;
using catalogue::StressDropIs;
using catalogue::UncertainConstant;
using medium::Defaults;
using medium::Elastic;
using medium::elastic;

namespace {

/// The observed quantities that the estimate uses, as single numbers.
struct Observed {
  std::optional<double> V, w, slip, time, drop, strength;

  std::optional<double> slip_velocity() const {
    if (w) return w;
    if (slip && time) return *slip / *time;
    return std::nullopt;
  }
};

/// Replaces a number that is not finite by NaN. Such numbers arise from a slip of 1e306 m, for example.
void reset_unless_finite(double& x) {
  if (!std::isfinite(x)) x = std::numeric_limits<double>::quiet_NaN();
}

/// The state of the fault at one choice of the observed numbers.
FaultState infer(const Observed& observed, const Elastic& e, std::optional<double> given_A, const Observation& o) {
  const SlipVelocityKind measure = o.measure();
  FaultState s = unknown_state();
  if (!given_A && observed.drop && observed.V) {
    const rupture::Relations r = rupture::from_rupture_velocity(*observed.V / e.speed);
    const double drop = o.stress_drop_is == StressDropIs::stored ? r.stress : r.stress - r.stress_at_origin;
    given_A = *observed.drop / medium::stress_unit(e.shear_modulus, 1) / drop;
  } else if (!given_A && observed.strength) {
    given_A = observed.strength;
  }
  const std::optional<double> w = observed.slip_velocity();
  if (given_A) s.contact_ratio = *given_A;
  if (observed.V) {
    s.rupture_velocity_m_s = *observed.V;
    s.rupture_velocity = *observed.V / e.speed;
    const rupture::Relations r = rupture::from_rupture_velocity(s.rupture_velocity);
    // Friction slows an observed front, so its stress is at least that of the closed form.
    (o.rupture_velocity_is == RuptureVelocityIs::front ? s.stress_bound : s.stress) = r.stress;
    s.frictionless_slip_velocity = r.slip_velocity;
    if (!given_A && w)  // pi w / (c W)
      s.contact_ratio_bound =
          *w / medium::slip_velocity_unit(e.speed, frictionless(measure, r.stress, r.slip_velocity));
  } else if (given_A && w) {
    s.stress_bound = rupture::from_slip_velocity(*w / medium::slip_velocity_unit(e.speed, *given_A)).stress;
  }
  derive(s, e, w);
  for (double* x : {&s.contact_ratio, &s.observed_slip_velocity, &s.slip_velocity_ratio, &s.stress_pa,
                    &s.contact_ratio_bound, &s.stress_pa_bound})
    reset_unless_finite(*x);
  return s;
}

/// The states at the 5 % and 95 % quantiles of one observed quantity. All other quantities are at their middles.
struct Spread {
  FaultState at_5, at_95;
};

/// An inferred quantity. It has an interval if exactly one observational error changes it. Sets `blurred` if several
/// errors do.
std::optional<Inferred> inferred(const FaultState& middle, const std::vector<Spread>& spreads,
                                 double FaultState::*member, bool& blurred) {
  if (std::isnan(middle.*member)) return std::nullopt;
  Inferred result{middle.*member, std::nullopt};
  int moved_by = 0;
  for (const Spread& spread : spreads) {
    const double a = spread.at_5.*member, b = spread.at_95.*member;
    if (a == b || (std::isnan(a) && std::isnan(b))) continue;
    ++moved_by;
    if (!std::isnan(a) && !std::isnan(b)) result.interval = Interval{std::fmin(a, b), std::fmax(a, b)};
  }
  if (moved_by > 1 || (moved_by == 1 && !result.interval)) {
    result.interval.reset();
    blurred = true;
  }
  return result;
}

/// Whether the error of a quantity, whose middle is not below `limit`, reaches below it.
bool may_reach_below(const MeasuredValue& m, double limit) {
  return m.shape == MeasuredValue::Shape::range ? m.low < limit : true;
}

/// Rejects an observed A or V that is out of range. If the event is sampled and the error reaches into the range, it
/// warns instead.
void check_reach(const Observation& o, const Elastic& e, double plastic, bool is_sampled,
                 std::vector<std::string>& warnings) {
  const MeasuredValue* contact = nullptr;
  for (const UncertainConstant& c : o.uncertain_constants)
    if (c.member == &medium::Constants::contact_ratio) contact = &c.measured;
  if (o.contact_ratio && !(*o.contact_ratio > 0 && *o.contact_ratio <= plastic)) {
    if (!is_sampled || !contact || !may_reach_below(*contact, plastic))
      throw InputError({.key = "contact_ratio",
                        .value = digits(*o.contact_ratio),
                        .problem = "out of range",
                        .allowed = "0 < contact_ratio <= " + digits(plastic) + " (plastic contact)"});
    warnings.push_back("contact_ratio exceeds plastic contact: only the part of its distribution below counts");
  }
  if (!o.rupture_velocity_m_s || o.rupture_velocity_m_s->high < e.speed) return;
  if (!is_sampled || !may_reach_below(*o.rupture_velocity_m_s, e.speed))
    throw InputError({.key = "rupture_velocity",
                      .value = digits(o.rupture_velocity_m_s->high) + " m/s",
                      .problem = "not below the speed c of the model",
                      .allowed = "rupture_velocity < c = " + digits(e.speed) + " m/s"});
  warnings.push_back(
      "rupture_velocity is not below the speed c of the model: only the part of its distribution below c counts");
}

/// The observed quantities at their middles, and those that have an error.
struct ObservedNumbers {
  Observed middle;
  std::vector<std::pair<std::optional<double> Observed::*, MeasuredValue>> uncertain;

  void add(const std::optional<MeasuredValue>& measured, std::optional<double> Observed::*member) {
    if (!measured) return;
    middle.*member = measured->middle();
    if (!measured->is_exact()) uncertain.emplace_back(member, *measured);
  }
};

ObservedNumbers observed_numbers(const Observation& o, const Elastic& e) {
  ObservedNumbers n;
  if (o.rupture_velocity_m_s && o.rupture_velocity_m_s->high < e.speed) n.add(o.rupture_velocity_m_s, &Observed::V);
  n.add(o.stress_drop, &Observed::drop);
  if (o.slip_velocity_m_s) {
    n.add(o.slip_velocity_m_s, &Observed::w);
  } else if (const MeasuredValue* time = o.slip_time()) {
    n.add(o.slip, &Observed::slip);
    n.add(*time, &Observed::time);
  }
  if (o.normal_stress && o.hardness)
    n.middle.strength = medium::contact_ratio(o.normal_stress->middle(), o.hardness->middle(), e.poisson_ratio,
                                              medium::ContactForm::derived);
  return n;
}

/// The states at both quantiles of each uncertain observed quantity.
std::vector<Spread> spreads_of(const ObservedNumbers& numbers, const Observation& o, const Elastic& e) {
  std::vector<Spread> spreads;
  for (const auto& [member, measured] : numbers.uncertain) {
    const auto at = [&, member = member, measured = measured](double probability) {
      Observed shifted = numbers.middle;
      const double value = measured.quantile(probability);
      (shifted.*member).reset();
      if (value > 0 && !(member == &Observed::V && value >= e.speed)) shifted.*member = value;
      return infer(shifted, e, o.contact_ratio, o);
    };
    spreads.push_back({at(0.05), at(0.95)});
  }
  return spreads;
}

/// Whether constants of the medium have errors. They change all quantities at once, so only samples give intervals.
bool has_uncertain_constants(const Observation& o) {
  return !o.uncertain_constants.empty() || (o.normal_stress && !o.normal_stress->is_exact()) ||
         (o.hardness && !o.hardness->is_exact());
}

/// Fills the result from the state at the middles and from the spreads. Returns whether several errors change a
/// quantity.
bool fill(Estimate& result, const FaultState& middle, const std::vector<Spread>& spreads, bool with_intervals) {
  bool blurred = false;
  for (const Quantity& q : quantities()) {
    auto& answer = result.*q.inferred;
    answer = inferred(middle, spreads, q.state, blurred);
    if (answer && !with_intervals) answer->interval.reset();
  }
  // If only a bound is known, the bound is the result.
  if (result.contact_ratio_bound) result.contact_ratio = result.contact_ratio_bound;
  if (result.stress_bound) result.stress = result.stress_bound;
  return blurred;
}

void add_warnings(Estimate& result, const Observation& o, double plastic, bool is_sampled) {
  auto& warnings = result.warnings;
  const bool front = o.rupture_velocity_is == RuptureVelocityIs::front;
  const bool knows_friction = o.friction_coefficient && o.asperity_spacing && o.damping_time();
  if (!o.rupture_velocity_m_s) {
    warnings.push_back(result.stress
                           ? "no rupture_velocity: stress is a lower bound, from the slip velocity without friction"
                           : "no rupture_velocity: stress is not identifiable");
  } else if (result.rupture_velocity && !result.contact_ratio) {
    warnings.push_back("no slip velocity and no contact_ratio: stress in Pa is not identifiable");
  } else if (result.contact_ratio_bound && !(is_sampled && (front || knows_friction))) {
    warnings.push_back("contact_ratio and stress_pa have only lower bounds, the values without friction");
  }
  if (front && o.rupture_velocity_m_s && !(is_sampled && (o.has_slip_velocity() || o.stress_drop)))
    warnings.push_back("stress is a lower bound, because friction slows the observed front");
  if (result.contact_ratio && result.contact_ratio->value > plastic)
    warnings.push_back("contact_ratio " + digits(result.contact_ratio->value) + " exceeds plastic contact, " +
                       digits(plastic) + ": slip velocity too high for this rupture velocity");
  if (!is_sampled && result.slip_velocity_ratio && result.slip_velocity_ratio->value > 1)
    warnings.push_back("slips faster than without friction: contact_ratio or the velocities are inaccurate");
}

}  // namespace

Estimate estimate(const Observation& o, const Defaults& defaults, bool is_sampled) try {
  Estimate result;
  result.warnings = o.warnings;
  std::string assumed;
  const Elastic e = elastic(o, defaults, &assumed);
  if (!assumed.empty()) result.warnings.push_back("assumed: " + assumed);
  result.speed = e.speed;
  const double plastic = medium::plastic_contact_ratio(e.poisson_ratio);
  check_reach(o, e, plastic, is_sampled, result.warnings);
  if (o.slip_time())
    result.warnings.push_back(std::string("slip_velocity is slip / ") + (o.rise_time ? "rise_time" : "duration"));

  const ObservedNumbers numbers = observed_numbers(o, e);
  if (o.rupture_velocity_m_s) result.observed_rupture_velocity_m_s = o.rupture_velocity_m_s->middle();
  result.observed_slip_velocity_m_s = numbers.middle.slip_velocity();
  const bool moved = has_uncertain_constants(o);
  const bool blurred = fill(result, infer(numbers.middle, e, o.contact_ratio, o), spreads_of(numbers, o, e), !moved);
  if (!is_sampled && (blurred || moved))
    result.warnings.push_back(
        "several observed errors change a quantity: values are at the middle of each, and intervals need samples");
  add_warnings(result, o, plastic, is_sampled);
  return result;
} catch (const InputError& error) {
  Complaint complaint = error.complaint();
  complaint.file = o.file;
  complaint.line = o.line;
  throw InputError(complaint);
}

using catalogue::MeasuredValue;
using catalogue::Observation;

namespace {

constexpr std::array<ObservedQuantity, std::tuple_size_v<ObservedValues>> observed_declarations = {{
    {"rupture_velocity", "rupture velocity", "m s-1"},
    {"slip_velocity", "slip velocity", "m s-1"},
    {"slip", "slip", "m"},
    {"contact_ratio", "contact ratio A", "1"},
    {"stress_drop", "stress drop", "Pa"},
    {"normal_stress", "normal stress", "Pa"},
    {"friction_coefficient", "coefficient C of the viscous friction", "1"},
}};

}  // namespace

std::span<const ObservedQuantity> observed_quantities() { return observed_declarations; }

std::size_t position_of(std::string_view name) {
  for (std::size_t i = 0; i < observed_declarations.size(); ++i)
    if (observed_declarations[i].name == name) return i;
  throw std::out_of_range("no observed quantity of this name");
}

ObservedValues observed_values(const Observation& o) {
  constexpr double none = std::numeric_limits<double>::quiet_NaN();
  const auto middle = [](const std::optional<MeasuredValue>& m) { return m ? m->middle() : none; };
  return {middle(o.rupture_velocity_m_s), middle(o.slip_velocity_m_s), middle(o.slip),
          o.contact_ratio.value_or(none), middle(o.stress_drop),       middle(o.normal_stress),
          middle(o.friction_coefficient)};
}

double repeated(const MeasuredValue& m, double x, double probability) {
  if (m.is_exact()) return x;
  MeasuredValue around = m;
  around.low = around.high = x;
  if (m.shape == MeasuredValue::Shape::range) {
    around.low = x - (m.high - m.low) / 2;
    around.high = x + (m.high - m.low) / 2;
  } else if (m.shape == MeasuredValue::Shape::split) {
    // The error below an observed value is its distance from a smaller true value, so the observed value is above.
    around.shape = MeasuredValue::Shape::normal;
    around.spread = probability > 0.5 ? m.spread_below : m.spread;
  }
  return around.quantile(probability);
}

}  // namespace slipfront::inference
