#include "inference/sampling/evidence.hpp"

#include <algorithm>
#include <cmath>

#include "slipfront/medium/medium.hpp"

namespace slipfront::inference {

using catalogue::Measured;
using catalogue::Observation;
using catalogue::UncertainConstant;
using medium::Constants;

namespace {

double squared(double x) { return x * x; }

double squared_spread(const Measured* m) { return m && !m->is_exact() ? squared(log_spread(*m)) : 0; }

const Measured* uncertain_constant(const Observation& o, std::optional<double> Constants::*member) {
  for (const UncertainConstant& c : o.uncertain_constants)
    if (c.member == member) return &c.measured;
  return nullptr;
}

/// Variance in ln that the uncertain elastic constants add to every observation, approximately.
double elastic_blur(const Observation& o) {
  double sum = 0;
  for (const UncertainConstant& c : o.uncertain_constants)
    if (c.member != &Constants::contact_ratio && c.member != &Constants::asperity_spacing)
      sum += squared(log_spread(c.measured));
  return sum;
}

}  // namespace

double log_spread(const Measured& m) {
  if (m.shape == Measured::Shape::lognormal) return std::log(m.spread);
  if (m.shape == Measured::Shape::normal) return m.spread / m.low;
  if (m.shape == Measured::Shape::split) return (m.spread + m.spread_below) / 2 / m.low;
  return m.is_exact() ? 0 : std::log(m.high / m.low) / std::sqrt(12.0);
}

double Evidence::spread() const { return std::hypot(log_spread(measured), blur); }

double Evidence::blurred_likelihood(double ln_x, double resolution, bool falls) const {
  const double more = std::hypot(blur, resolution);
  double z = 0;
  switch (measured.shape) {
    case Measured::Shape::lognormal:
      z = (ln_x - std::log(measured.low)) / std::hypot(std::log(measured.spread), more);
      break;
    case Measured::Shape::normal:
    case Measured::Shape::split: {
      const double x = std::exp(ln_x);
      const bool under = measured.shape == Measured::Shape::split && x < measured.low;
      // A value that is uncertain by a factor may be near the observed one, however small it is.
      const double blurred = more * (more > 1 ? std::fmax(x, measured.low) : x);
      z = (x - measured.low) / std::hypot(under ? measured.spread_below : measured.spread, blurred);
      if (falls && x > measured.low)
        z = std::fmax(z, (ln_x - std::log(measured.low)) / std::hypot(measured.spread / measured.low, more));
      break;
    }
    case Measured::Shape::range: {
      const double outside = std::fmax(std::log(measured.low) - ln_x, ln_x - std::log(measured.high));
      z = std::fmax(outside, 0.0) / std::fmax(more, 1e-6);
    }
  }
  return std::exp(-z * z / 2);
}

double Evidence::offset(const PulseState& p, double u, const Surroundings& around) const {
  switch (source) {
    case Source::slip:  // w = c A W / pi
      return std::log(medium::slip_velocity_unit(around.elastic.speed, 1) * p.W * around.slipping);
    case Source::contact:
      return 0;
    case Source::drop:  // mu A / pi times the share of Sigma- that was observed
      return std::log(medium::stress_unit(around.elastic.shear_modulus, 1) * p.stress * p.drop_share);
    case Source::strength:  // A = A_plastic normal stress / hardness
      return std::log(around.hardness / around.plastic);
    case Source::friction:  // C = Gamma b / (T c A)
      return std::log(std::expm1(u) * around.spacing / (around.duration * around.elastic.speed));
  }
  return 0;
}

void sort_by_precision(std::vector<Evidence>& evidence) {
  std::stable_sort(evidence.begin(), evidence.end(), [](const Evidence& a, const Evidence& b) {
    if (a.measured.is_exact() || b.measured.is_exact()) return a.measured.is_exact() && !b.measured.is_exact();
    return a.spread() < b.spread();
  });
}

std::vector<Evidence> evidence_of(const Observation& o) {
  std::vector<Evidence> all;
  const double elastic = elastic_blur(o);
  if (o.has_slip_velocity()) {
    const Measured& m = o.slip_velocity_m_s ? *o.slip_velocity_m_s : *o.slip;
    all.push_back({Source::slip, o.slip_velocity_m_s ? "slip_velocity" : "slip", m,
                   std::sqrt(elastic + squared_spread(o.slip_time()))});
  }
  if (o.contact_ratio) {
    const Measured* m = uncertain_constant(o, &Constants::contact_ratio);
    all.push_back({Source::contact, "contact_ratio", m ? *m : Measured{*o.contact_ratio, *o.contact_ratio}, 0});
  }
  if (o.stress_drop) all.push_back({Source::drop, "stress_drop", *o.stress_drop, std::sqrt(elastic)});
  if (o.normal_stress && o.hardness)
    all.push_back({Source::strength, "normal_stress", *o.normal_stress, std::sqrt(squared_spread(&*o.hardness))});
  if (o.friction_coefficient && o.asperity_spacing && o.damping_time()) {
    const double blur = elastic + squared_spread(o.damping_time()) +
                        squared_spread(uncertain_constant(o, &Constants::asperity_spacing));
    all.push_back({Source::friction, "friction_coefficient", *o.friction_coefficient, std::sqrt(blur)});
  }
  sort_by_precision(all);
  return all;
}

}  // namespace slipfront::inference
