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
  double left = substrate(face_psi_[0]);
  for (std::size_t i = 0; i < size(); ++i) {
    const double right = substrate(face_psi_[i + 1]);
    const double a = square(face_contact_[i]), b = square(contact_[i]), c = square(face_contact_[i + 1]);
    contact_force_[i] = 0;
    if (a != b || b != c)
      contact_force_[i] =
          -(left * (4 * b - 3 * a - c) + 4 * substrate(at_.psi[i]) * (c - a) + right * (a - 4 * b + 3 * c)) / 6;
    rates.momentum(i) += contact_force_[i];
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
    rates.dissipated() = damp(n, *C, y, at_.velocity.data(), dy);
    return;
  }
  for (std::size_t i = 0; i < n; ++i) {
    const double U = at_.velocity[i];
    source_[i] = 0;
    if (setup_.forcing) {
      const double push = 2 * pi * setup_.forcing(centres_[i], t) * charge_point_[i];
      supply += U * push;
      source_[i] += push;
    }
    if (frictional && !dry) {
      const double loss = rate_[i] * at_.momentum[i] * charge_point_[i];
      dissipation += U * loss;
      if (!linear) source_[i] -= loss;
    }
  }
  for (const Stretch& r : stretches_)
    cell_means(r.end - r.begin, source_.data() + r.begin, source_mean_.data() + r.begin);
  for (std::size_t i = 0; i < n; ++i) {
    rates.momentum(i) += source_mean_[i];
    if (dry) {  // no detour over point values, as of a constant force there is none
      const double force =
          dry_friction(values.momentum(i), rates.momentum(i), 2 * pi * strength_[i] * setup_.charge[i]);
      dissipation -= at_.velocity[i] * force;
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
  largest_rate_ = 0;
  if (!f.acts()) return;
  if (const auto C = f.linear_coefficient()) {
    if (f.closure() == friction::Closure::consistent) {
      std::fill(rate_.begin(), rate_.end(), *C);
      largest_rate_ = *C;
    } else {  // with the E K that are known already
      largest_rate_ = paper_rates(size(), *C, at_.EK.data(), rate_.data());
    }
    return;
  }
  for (std::size_t i = 0; i < size(); ++i) {
    if (gap(i)) continue;
    const State state{at_.phi[i], at_.psi[i]};
    const double a = setup_.contact ? contact_[i] : 1;
    if (f.sticks()) {  // such friction relaxes nothing, but stops it
      strength_[i] = f.mean_strength(state, a);
    } else {
      rate_[i] = (*relaxation_rate_)(state, a);
      largest_rate_ = std::max(largest_rate_, rate_[i]);
    }
  }
}

}  // namespace slipfront::pulse
