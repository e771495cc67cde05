#include "slipfront/event/estimate.hpp"

#include <cmath>
#include <utility>

#include "../digits.hpp"
#include "elastic.hpp"
#include "slipfront/medium/medium.hpp"
#include "slipfront/rupture/relations.hpp"

namespace slipfront::event {
namespace {

/// The observed quantities that enter, as single numbers.
struct Observed {
  std::optional<double> V, w, slip, time, drop;

  std::optional<double> slip_velocity() const {
    if (w) return w;
    if (slip && time) return *slip / *time;
    return std::nullopt;
  }
};

/// The inferred numbers at one choice of the observed ones.
struct Numbers {
  std::optional<double> V, stress, frictionless, observed, ratio, A, stress_pa;
};

Numbers infer(const Observed& observed, const Elastic& e, std::optional<double> given_A) {
  Numbers n;
  if (!given_A && observed.drop && observed.V)
    given_A = *observed.drop / medium::stress_unit(e.shear_modulus, 1) /
              rupture::from_rupture_velocity(*observed.V / e.speed).stress;
  const std::optional<double> w = observed.slip_velocity();
  n.A = given_A;
  if (given_A && w) n.observed = *w / medium::slip_velocity_unit(e.speed, *given_A);
  if (observed.V) {
    n.V = *observed.V / e.speed;
    const rupture::Relations r = rupture::from_rupture_velocity(*n.V);
    n.stress = r.stress;
    n.frictionless = r.slip_velocity;
    if (!given_A && w) n.A = *w / medium::slip_velocity_unit(e.speed, r.slip_velocity);  // pi w / (c W)
    if (n.observed) n.ratio = *n.observed / r.slip_velocity;
  } else if (n.observed) {
    n.stress = rupture::from_slip_velocity(*n.observed).stress;
  }
  if (n.stress && n.A) n.stress_pa = medium::stress_unit(e.shear_modulus, *n.A) * *n.stress;
  for (auto* x : {&n.A, &n.observed, &n.ratio, &n.stress_pa})  // of a slip of 1e306 m, say
    if (*x && !std::isfinite(**x)) x->reset();
  return n;
}

/// What follows from the ends of one observed range, at its 5 % and 95 % quantiles, all else at the middle.
struct Spread {
  Numbers at_5, at_95;
};

/// An inferred quantity with its interval, where exactly one observed range moves it; `blurred` where several do.
std::optional<Inferred> inferred(const Numbers& middle, const std::vector<Spread>& spreads,
                                 std::optional<double> Numbers::*member, bool& blurred) {
  if (!(middle.*member)) return std::nullopt;
  Inferred result{*(middle.*member), std::nullopt};
  int moved_by = 0;
  for (const Spread& spread : spreads) {
    const double a = *(spread.at_5.*member), b = *(spread.at_95.*member);
    if (a == b) continue;
    ++moved_by;
    result.interval = Interval{std::fmin(a, b), std::fmax(a, b)};
  }
  if (moved_by > 1) {
    result.interval.reset();
    blurred = true;
  }
  return result;
}

}  // namespace

Estimate estimate(const Observation& o, const MediumDefaults& defaults) try {
  Estimate result;
  result.warnings = o.warnings;
  std::string assumed;
  const Elastic e = elastic(o, defaults, &assumed);
  if (!assumed.empty()) result.warnings.push_back("assumed: " + assumed);
  result.speed = e.speed;
  const double plastic = medium::plastic_contact_ratio(e.poisson_ratio);
  if (o.contact_ratio && !(*o.contact_ratio > 0 && *o.contact_ratio <= plastic))
    throw InputError({.key = "contact_ratio",
                      .value = digits(*o.contact_ratio),
                      .problem = "out of range",
                      .allowed = "0 < contact_ratio <= " + digits(plastic) + " (plastic contact)"});
  if (o.rupture_velocity && !(o.rupture_velocity->high < e.speed))
    throw InputError({.key = "rupture_velocity",
                      .value = digits(o.rupture_velocity->high) + " m/s",
                      .problem = "not below the speed c of the model",
                      .allowed = "rupture_velocity < c = " + digits(e.speed) + " m/s"});

  std::optional<double> given_A = o.contact_ratio;
  if (!given_A && o.normal_stress && o.hardness && !o.stress_drop)
    given_A = medium::contact_ratio(o.normal_stress->middle(), o.hardness->middle(), e.poisson_ratio,
                                    medium::ContactForm::derived);
  Observed middle;
  std::vector<std::pair<std::optional<double> Observed::*, Measured>> ranges;
  const auto take = [&](const std::optional<Measured>& measured, std::optional<double> Observed::*member) {
    if (!measured) return;
    middle.*member = measured->middle();
    if (measured->is_range()) ranges.emplace_back(member, *measured);
  };
  take(o.rupture_velocity, &Observed::V);
  take(o.stress_drop, &Observed::drop);
  if (o.slip_velocity) {
    take(o.slip_velocity, &Observed::w);
  } else if (o.slip && (o.rise_time || o.duration)) {
    take(o.slip, &Observed::slip);
    take(o.rise_time ? o.rise_time : o.duration, &Observed::time);
    result.warnings.push_back(std::string("slip_velocity is slip / ") + (o.rise_time ? "rise_time" : "duration"));
  }

  const Numbers n = infer(middle, e, given_A);
  std::vector<Spread> spreads;
  for (const auto& [member, range] : ranges) {
    const auto at = [&, member = member, range = range](double quantile) {
      Observed shifted = middle;
      shifted.*member = range.low + quantile * (range.high - range.low);
      return infer(shifted, e, given_A);
    };
    spreads.push_back({at(0.05), at(0.95)});
  }
  bool blurred = false;
  const auto fill = [&](std::optional<double> Numbers::*member) { return inferred(n, spreads, member, blurred); };
  result.observed_rupture_velocity = middle.V;
  result.observed_slip_velocity_m_s = middle.slip_velocity();
  result.rupture_velocity = fill(&Numbers::V);
  result.stress = fill(&Numbers::stress);
  result.frictionless_slip_velocity = fill(&Numbers::frictionless);
  result.observed_slip_velocity = fill(&Numbers::observed);
  result.slip_velocity_ratio = fill(&Numbers::ratio);
  result.contact_ratio = fill(&Numbers::A);
  result.stress_pa = fill(&Numbers::stress_pa);

  if (blurred) result.warnings.push_back("moved by several observed ranges: the middle of each, no interval");
  if (!n.V) {
    result.warnings.push_back(n.stress
                                  ? "no rupture_velocity: stress from the slip velocity, as if there were no friction"
                                  : "no rupture_velocity: stress is not identifiable");
  } else if (!n.A) {
    result.warnings.push_back("no slip velocity and no contact_ratio: stress in Pa is not identifiable");
  } else if (!given_A && !o.stress_drop) {
    result.warnings.push_back("contact_ratio as if there were no friction: a lower bound");
  }
  if (n.A && *n.A > plastic)
    result.warnings.push_back("contact_ratio " + digits(*n.A) + " exceeds plastic contact, " + digits(plastic) +
                              ": slip velocity too high for this rupture velocity");
  if (n.ratio && *n.ratio > 1)
    result.warnings.push_back("slips faster than without friction: contact_ratio or the velocities are off");
  return result;
} catch (const InputError& error) {
  Complaint complaint = error.complaint();
  complaint.file = o.file;
  complaint.line = o.line;
  throw InputError(complaint);
}

}  // namespace slipfront::event
