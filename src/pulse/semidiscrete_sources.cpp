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

/// Coulomb friction on one cell that is pushed by `push`: opposes motion with `most`, or holds a cell that is at rest.
double coulomb(double momentum, double push, double most) {
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
  const auto square = [](double a) { return a * a; };
  double left = substrate(face_psi_[0]);
  for (std::size_t i = 0; i < size(); ++i) {
    const double right = substrate(face_psi_[i + 1]);
    const double a = square(face_contact_[i]), b = square(contact_[i]), c = square(face_contact_[i + 1]);
    contact_force_[i] = 0;
    if (a != b || b != c)
      contact_force_[i] =
          -(left * (4 * b - 3 * a - c) + 4 * substrate(at_.psi[i]) * (c - a) + right * (a - 4 * b + 3 * c)) / 6;
    dy[2 * i + 1] += contact_force_[i];
    left = right;
  }
}

void Semidiscrete::add_sources(double t, const double* y, double* dy) {
  const std::size_t n = size();
  const modulation::Friction& friction = setup_.friction;
  const bool frictional = friction.acts();
  const bool dry = frictional && friction.law == modulation::FrictionLaw::coulomb;
  const bool linear =
      friction.law == modulation::FrictionLaw::viscous && friction.closure == modulation::Closure::consistent;
  if (!frictional && !setup_.forcing) return;
  double dissipation = 0, supply = 0;
  if (linear && !setup_.forcing) {  // the plain case, without the detour over point values
    dy[2 * n + 1] = damp(n, friction.coefficient, y, at_.velocity.data(), dy);
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
    dy[2 * i + 1] += source_mean_[i];
    if (dry) {  // the same for each dislocation: no detour over point values
      const double force = coulomb(y[2 * i + 1], dy[2 * i + 1], 2 * pi * friction.coefficient * setup_.charge[i]);
      dissipation -= at_.velocity[i] * force;
      dy[2 * i + 1] += force;
    } else if (frictional && linear) {
      dy[2 * i + 1] -= friction.coefficient * y[2 * i + 1];
    }
  }
  // M = 2 pi P / k and 2 pi q_s = k x_s: the sums are over P dx = M q_s ds.
  dy[2 * n + 1] = dissipation;
  dy[2 * n + 2] = supply;
}

void Semidiscrete::find_rates() {
  const modulation::Friction& f = setup_.friction;
  if (f.law == modulation::FrictionLaw::viscous) {  // as relaxation_rate, with the E K that are known already
    if (f.closure == modulation::Closure::consistent) {
      std::fill(rate_.begin(), rate_.end(), f.coefficient);
      largest_rate_ = f.coefficient;
    } else {
      largest_rate_ = paper_rates(size(), f.coefficient, at_.EK.data(), rate_.data());
    }
    return;
  }
  largest_rate_ = 0;
  if (f.law != modulation::FrictionLaw::power) return;
  for (std::size_t i = 0; i < size(); ++i) {
    if (gap(i)) continue;
    rate_[i] = power_law_rate_({at_.phi[i], at_.psi[i]});
    if (setup_.contact) rate_[i] *= std::pow(contact_[i], f.exponent - 1);  // <|w|^n sigma> over P, w in units of a
    largest_rate_ = std::max(largest_rate_, rate_[i]);
  }
}

}  // namespace slipfront::pulse
