#include "slipfront/inference/estimate.hpp"

#include <cmath>
#include <utility>

#include "../digits.hpp"
#include "balance.hpp"
#include "slipfront/medium/elastic.hpp"
#include "slipfront/medium/medium.hpp"
#include "slipfront/rupture/relations.hpp"

namespace slipfront::inference {

using catalogue::Measure;
using catalogue::Measured;
using catalogue::Observation;
using catalogue::UncertainConstant;
using medium::Defaults;
using medium::Elastic;
using medium::elastic;

namespace {

/// The observed quantities that enter, as single numbers.
struct Observed {
  std::optional<double> V, w, slip, time, drop, strength;

  std::optional<double> slip_velocity() const {
    if (w) return w;
    if (slip && time) return *slip / *time;
    return std::nullopt;
  }
};

/// The inferred numbers at one choice of the observed ones.
struct Numbers {
  std::optional<double> V, stress, frictionless, observed, ratio, A, stress_pa, stress_bound, A_bound, stress_pa_bound;
};

Numbers infer(const Observed& observed, const Elastic& e, std::optional<double> given_A, Measure measure) {
  Numbers n;
  if (!given_A && observed.drop && observed.V)
    given_A = *observed.drop / medium::stress_unit(e.shear_modulus, 1) /
              rupture::from_rupture_velocity(*observed.V / e.speed).stress;
  else if (!given_A && observed.strength)
    given_A = observed.strength;
  const std::optional<double> w = observed.slip_velocity();
  n.A = given_A;
  if (given_A && w) n.observed = *w / medium::slip_velocity_unit(e.speed, *given_A);
  if (observed.V) {
    n.V = *observed.V / e.speed;
    const rupture::Relations r = rupture::from_rupture_velocity(*n.V);
    n.stress = r.stress;
    n.frictionless = r.slip_velocity;
    if (!given_A && w)  // pi w / (c W)
      n.A = n.A_bound = *w / medium::slip_velocity_unit(e.speed, frictionless(measure, r.stress, r.slip_velocity));
    if (n.observed) n.ratio = *n.observed / r.slip_velocity;
  } else if (n.observed) {
    n.stress = n.stress_bound = rupture::from_slip_velocity(*n.observed).stress;
  }
  if (n.stress && n.A)
    (n.A_bound || n.stress_bound ? n.stress_pa_bound : n.stress_pa) =
        medium::stress_unit(e.shear_modulus, *n.A) * *n.stress;
  for (auto* x : {&n.A, &n.observed, &n.ratio, &n.stress_pa, &n.A_bound, &n.stress_pa_bound})  // a slip of 1e306 m, say
    if (*x && !std::isfinite(**x)) x->reset();
  return n;
}

/// What follows from the 5 % and 95 % quantiles of one observed quantity, all else at the middle.
struct Spread {
  Numbers at_5, at_95;
};

/// An inferred quantity with its interval, where exactly one observed error moves it; `blurred` where several do.
std::optional<Inferred> inferred(const Numbers& middle, const std::vector<Spread>& spreads,
                                 std::optional<double> Numbers::*member, bool& blurred) {
  if (!(middle.*member)) return std::nullopt;
  Inferred result{*(middle.*member), std::nullopt};
  int moved_by = 0;
  for (const Spread& spread : spreads) {
    const auto &a = spread.at_5.*member, &b = spread.at_95.*member;
    if (a == b) continue;
    ++moved_by;
    if (a && b) result.interval = Interval{std::fmin(*a, *b), std::fmax(*a, *b)};
  }
  if (moved_by > 1 || (moved_by == 1 && !result.interval)) {
    result.interval.reset();
    blurred = true;
  }
  return result;
}

/// Whether the errors of a quantity may reach below `limit` from a middle that does not.
bool may_reach_below(const Measured& m, double limit) {
  return m.shape == Measured::Shape::range ? m.low < limit : true;
}

/// What is wrong with a given A or V, unless samples may mend it: then a warning.
void check_reach(const Observation& o, const Elastic& e, double plastic, bool is_sampled,
                 std::vector<std::string>& warnings) {
  const Measured* contact = nullptr;
  for (const UncertainConstant& c : o.uncertain_constants)
    if (c.member == &medium::Constants::contact_ratio) contact = &c.measured;
  if (o.contact_ratio && !(*o.contact_ratio > 0 && *o.contact_ratio <= plastic)) {
    if (!is_sampled || !contact || !may_reach_below(*contact, plastic))
      throw InputError({.key = "contact_ratio",
                        .value = digits(*o.contact_ratio),
                        .problem = "out of range",
                        .allowed = "0 < contact_ratio <= " + digits(plastic) + " (plastic contact)"});
    warnings.push_back("contact_ratio exceeds plastic contact: only what its error leaves below counts");
  }
  if (!o.rupture_velocity || o.rupture_velocity->high < e.speed) return;
  if (!is_sampled || !may_reach_below(*o.rupture_velocity, e.speed))
    throw InputError({.key = "rupture_velocity",
                      .value = digits(o.rupture_velocity->high) + " m/s",
                      .problem = "not below the speed c of the model",
                      .allowed = "rupture_velocity < c = " + digits(e.speed) + " m/s"});
  warnings.push_back("rupture_velocity is not below the speed c of the model: only what its error leaves below counts");
}

/// The observed quantities at their middles, and those that carry an error.
struct Taken {
  Observed middle;
  std::vector<std::pair<std::optional<double> Observed::*, Measured>> uncertain;

  void take(const std::optional<Measured>& measured, std::optional<double> Observed::*member) {
    if (!measured) return;
    middle.*member = measured->middle();
    if (!measured->is_exact()) uncertain.emplace_back(member, *measured);
  }
};

Taken taken(const Observation& o, const Elastic& e) {
  Taken t;
  if (o.rupture_velocity && o.rupture_velocity->high < e.speed) t.take(o.rupture_velocity, &Observed::V);
  t.take(o.stress_drop, &Observed::drop);
  if (o.slip_velocity) {
    t.take(o.slip_velocity, &Observed::w);
  } else if (const Measured* time = o.slip_time()) {
    t.take(o.slip, &Observed::slip);
    t.take(*time, &Observed::time);
  }
  return t;
}

void add_warnings(Estimate& result, const Observation& o, const Numbers& n, double plastic, bool is_sampled) {
  auto& warnings = result.warnings;
  if (!o.rupture_velocity) {
    warnings.push_back(n.stress ? "no rupture_velocity: stress from the slip velocity, a lower bound, as if friction "
                                  "took nothing"
                                : "no rupture_velocity: stress is not identifiable");
  } else if (n.V && !n.A) {
    warnings.push_back("no slip velocity and no contact_ratio: stress in Pa is not identifiable");
  } else if (n.A_bound && !(is_sampled && o.friction_coefficient && o.asperity_spacing && o.damping_time())) {
    warnings.push_back("contact_ratio and stress_pa have lower bounds only, as if friction took nothing");
  }
  if (n.A && *n.A > plastic)
    warnings.push_back("contact_ratio " + digits(*n.A) + " exceeds plastic contact, " + digits(plastic) +
                       ": slip velocity too high for this rupture velocity");
  if (n.ratio && *n.ratio > 1)
    warnings.push_back("slips faster than without friction: contact_ratio or the velocities are off");
}

}  // namespace

Estimate estimate(const Observation& o, const medium::Defaults& defaults, bool is_sampled) try {
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

  std::optional<double> given_A = o.contact_ratio;
  Taken t = taken(o, e);
  if (o.normal_stress && o.hardness)
    t.middle.strength = medium::contact_ratio(o.normal_stress->middle(), o.hardness->middle(), e.poisson_ratio,
                                              medium::ContactForm::derived);
  const Numbers n = infer(t.middle, e, given_A, o.measure());
  std::vector<Spread> spreads;
  for (const auto& [member, measured] : t.uncertain) {
    const auto at = [&, member = member, measured = measured](double probability) {
      Observed shifted = t.middle;
      const double value = measured.quantile(probability);
      (shifted.*member).reset();
      if (value > 0 && !(member == &Observed::V && value >= e.speed)) shifted.*member = value;
      return infer(shifted, e, given_A, o.measure());
    };
    spreads.push_back({at(0.05), at(0.95)});
  }
  bool blurred = false;
  // Constants of the medium that carry errors move all at once: only samples can tell.
  const bool moved = !o.uncertain_constants.empty() || (o.normal_stress && !o.normal_stress->is_exact()) ||
                     (o.hardness && !o.hardness->is_exact());
  const auto fill = [&](std::optional<double> Numbers::*member) {
    auto found = inferred(n, spreads, member, blurred);
    if (found && moved) found->interval.reset();
    return found;
  };
  if (o.rupture_velocity) result.observed_rupture_velocity = o.rupture_velocity->middle();
  result.observed_slip_velocity_m_s = t.middle.slip_velocity();
  result.rupture_velocity = fill(&Numbers::V);
  result.stress = fill(&Numbers::stress);
  result.frictionless_slip_velocity = fill(&Numbers::frictionless);
  result.observed_slip_velocity = fill(&Numbers::observed);
  result.slip_velocity_ratio = fill(&Numbers::ratio);
  result.contact_ratio = fill(&Numbers::A);
  result.stress_pa = fill(&Numbers::stress_pa);
  result.stress_bound = fill(&Numbers::stress_bound);
  result.contact_ratio_bound = fill(&Numbers::A_bound);
  result.stress_pa_bound = fill(&Numbers::stress_pa_bound);

  if (!is_sampled && (blurred || moved))
    result.warnings.push_back("moved by several observed errors: the middle of each, no interval without samples");
  add_warnings(result, o, n, plastic, is_sampled);
  return result;
} catch (const InputError& error) {
  Complaint complaint = error.complaint();
  complaint.file = o.file;
  complaint.line = o.line;
  throw InputError(complaint);
}

}  // namespace slipfront::inference
