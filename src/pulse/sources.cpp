// What changes the momentum of a cell beside its faces: friction, forcing and the slope of the contact.

#include <algorithm>
#include <cmath>
#include <numbers>

#include "kernels.hpp"
#include "semidiscrete.hpp"
#include "slipfront/elliptic/complete.hpp"

namespace slipfront::pulse {
namespace {

using std::numbers::pi;

/// Dry friction on one cell that is pushed by `push`: opposes motion with `most`, or holds a cell that is at rest.
double dry_friction(double momentum, double push, double most) {
  if (momentum != 0) return -std::copysign(most, momentum);
  return -std::copysign(std::fmin(std::fabs(push), most), push);
}

/// <1 - cos u>, 2 cosh^2 psi (E/K - m1).
double substrate(double psi) {
  if (psi == 0) return 0;
  const double cosh_psi = std::cosh(psi);
  return 2 * cosh_psi * cosh_psi * elliptic::at_psi(psi).above_m1;
}

}  // namespace

/// Momentum that the contact gives to a cell, -integral of <1 - cos u> d(a^2), from both faces and the centre: fourth
/// order, and no derivative of a is needed.
void Semidiscrete::add_contact_force(double* dy) {
  const Values rates(dy, size());
  const auto square = [](double a) { return a * a; };
  double left = substrate(faces_.psi[0]);
  for (std::size_t i = 0; i < size(); ++i) {
    const double right = substrate(faces_.psi[i + 1]);
    const double a = square(faces_.contact[i]), b = square(centres_.contact[i]), c = square(faces_.contact[i + 1]);
    sources_.contact_force[i] = 0;
    if (a != b || b != c)
      sources_.contact_force[i] =
          -(left * (4 * b - 3 * a - c) + 4 * substrate(centres_.train.psi[i]) * (c - a) + right * (a - 4 * b + 3 * c)) /
          6;
    rates.momentum(i) += sources_.contact_force[i];
    left = right;
  }
}

void Semidiscrete::add_sources(double t, const double* y, double* dy) {
  const std::size_t n = size();
  const ConstValues values(y, n);
  const Values rates(dy, n);
  const friction::Friction& friction = setup_.friction;
  const bool frictional = friction.acts();
  const bool dry = friction.sticks();
  const std::optional<double> C = friction.linear_coefficient();
  const bool linear = C && friction.closure() == friction::Closure::consistent;
  if (!frictional && !setup_.forcing) return;
  double dissipation = 0, supply = 0;
  if (linear && !setup_.forcing) {  // the plain case, without the detour over point values
    rates.dissipated() = damp(n, *C, y, centres_.train.velocity.data(), dy);
    return;
  }
  for (std::size_t i = 0; i < n; ++i) {
    const double U = centres_.train.velocity[i];
    sources_.force[i] = 0;
    if (setup_.forcing) {
      const double push = 2 * pi * setup_.forcing(centres_.x[i], t) * centres_.charge[i];
      supply += U * push;
      sources_.force[i] += push;
    }
    if (frictional && !dry) {
      const double loss = sources_.friction_rate[i] * centres_.train.momentum[i] * centres_.charge[i];
      dissipation += U * loss;
      if (!linear) sources_.force[i] -= loss;
    }
  }
  for (const Block& r : blocks_)
    cell_means(r.end - r.begin, sources_.force.data() + r.begin, means_.source.data() + r.begin);
  for (std::size_t i = 0; i < n; ++i) {
    rates.momentum(i) += means_.source[i];
    if (dry) {  // no detour over point values, as of a constant force there is none
      const double force = dry_friction(values.momentum(i), rates.momentum(i),
                                        2 * pi * sources_.friction_strength[i] * setup_.charge[i]);
      dissipation -= centres_.train.velocity[i] * force;
      rates.momentum(i) += force;
    } else if (frictional && linear) {
      rates.momentum(i) -= *C * values.momentum(i);
    }
  }
  // M = 2 pi P / k and 2 pi q_s = k x_s: the sums are over P dx = M q_s ds.
  rates.dissipated() = dissipation;
  rates.supplied() = supply;
}

void Semidiscrete::find_rates() {
  const friction::Friction& f = setup_.friction;
  sources_.largest_friction_rate = 0;
  if (!f.acts()) return;
  if (const auto C = f.linear_coefficient()) {
    if (f.closure() == friction::Closure::consistent) {
      std::fill(sources_.friction_rate.begin(), sources_.friction_rate.end(), *C);
      sources_.largest_friction_rate = *C;
    } else {  // with the E K that are known already
      sources_.largest_friction_rate = paper_rates(size(), *C, centres_.train.EK.data(), sources_.friction_rate.data());
    }
    return;
  }
  for (std::size_t i = 0; i < size(); ++i) {
    if (gap(i)) continue;
    const State state{centres_.train.phi[i], centres_.train.psi[i]};
    const double a = setup_.contact ? centres_.contact[i] : 1;
    if (f.sticks()) {  // such friction relaxes nothing, but stops it
      sources_.friction_strength[i] = f.mean_strength(state, a);
    } else {
      sources_.friction_rate[i] = (*relaxation_rate_)(state, a, {});
      sources_.largest_friction_rate = std::max(sources_.largest_friction_rate, sources_.friction_rate[i]);
    }
  }
}

}  // namespace slipfront::pulse
