#include "semidiscrete.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <utility>

#include "kernels.hpp"
#include "slipfront/error.hpp"
#include "slipfront/modulation/per_dislocation.hpp"
#include "weno.hpp"

namespace slipfront::pulse {
namespace {

using std::numbers::pi;
constexpr std::size_t ghosts = 3;

}  // namespace

Semidiscrete::Semidiscrete(Setup setup) : setup_(std::move(setup)) {
  const std::size_t n = size();
  for (auto* array : {&charge_point_,
                      &per_charge_,
                      &per_charge_point_,
                      &width_,
                      &momentum_in_cell_,
                      &spacing_,
                      &momentum_,
                      &s_,
                      &phi_,
                      &psi_,
                      &phi_mean_,
                      &psi_mean_,
                      &sound_speed_,
                      &EK_,
                      &good_,
                      &rate_,
                      &source_,
                      &source_mean_,
                      &centres_,
                      &velocity_})
    array->assign(n, 0);
  for (auto* array : {&invariant_plus_, &invariant_minus_}) array->assign(n + 2 * ghosts, 0);
  for (auto* array : {&face_phi_, &face_psi_, &face_U_, &face_p_}) array->assign(n + 1, 0);
  centre_values(n, setup_.charge.data(), charge_point_.data());
  for (std::size_t i = 0; i < n; ++i) {
    per_charge_[i] = 1 / setup_.charge[i];
    per_charge_point_[i] = 1 / charge_point_[i];
  }
}

void Semidiscrete::start_from(const std::vector<double>& s) { s_ = s; }

std::vector<State> Semidiscrete::states() const {
  std::vector<State> states(size());
  for (std::size_t i = 0; i < size(); ++i) states[i] = {phi_[i], psi_[i]};
  return states;
}

void Semidiscrete::find_states(double t, const double* y) {
  const std::size_t n = size();
  split(n, y, width_.data(), momentum_in_cell_.data());
  if (compact_) {
    spacing_ = width_;
    momentum_ = momentum_in_cell_;
  } else {
    centre_values(n, width_.data(), spacing_.data());
    centre_values(n, momentum_in_cell_.data(), momentum_.data());
  }
  multiply(n, (compact_ ? per_charge_ : per_charge_point_).data(), spacing_.data(), momentum_.data());
  resolve_all({n, spacing_.data(), momentum_.data(), s_.data(), phi_.data(), psi_.data(), sound_speed_.data(),
               EK_.data(), velocity_.data(), good_.data()});
  for (std::size_t i = 0; i < n; ++i) {
    if (good_[i] != 0) continue;
    try {
      const double guess = std::atanh(std::fmin(std::fmax(s_[i], 0.0), 1 - 1e-16));
      const modulation::Resolved at = modulation::resolve({spacing_[i], momentum_[i]}, guess);
      phi_[i] = at.state.phi;
      psi_[i] = at.state.psi;
      s_[i] = std::tanh(at.state.psi);
      sound_speed_[i] = at.sound_speed;
      EK_[i] = at.EK;
      velocity_[i] = std::tanh(at.state.phi);
    } catch (const NumericsError& error) {
      throw NumericsError("t = " + std::to_string(t) + ", cell " + std::to_string(i) + " of " + std::to_string(n) +
                          ": " + error.what());
    }
  }
}

void Semidiscrete::find_faces() {
  const std::size_t n = size();
  cell_means(n, phi_.data(), phi_mean_.data());
  cell_means(n, psi_.data(), psi_mean_.data());
  double* plus = invariant_plus_.data() + ghosts;
  double* minus = invariant_minus_.data() + ghosts;
  const double scale = invariants(n, phi_mean_.data(), psi_mean_.data(), plus, minus);
  for (std::size_t g = 1; g <= ghosts; ++g) {
    // Beyond a free edge psi = 0, and the edge moves at the invariant that reaches it.
    *(plus - g) = setup_.left_free ? minus[0] : plus[0];
    *(minus - g) = minus[0];
    plus[n - 1 + g] = plus[n - 1];
    minus[n - 1 + g] = setup_.right_free ? plus[n - 1] : minus[n - 1];
  }
  weno_faces(n + 1, plus, minus, scale, face_phi_.data(), face_psi_.data());
  // At a free edge psi = 0; phi + psi (or phi - psi) is the invariant that reaches it.
  if (setup_.left_free) {
    face_phi_[0] = weno5(minus[2], minus[1], minus[0], minus[-1], minus[-2]) * scale;
    face_psi_[0] = 0;
  }
  if (setup_.right_free) {
    const double* p = plus + n;
    face_phi_[n] = weno5(p[-3], p[-2], p[-1], p[0], p[1]) * scale;
    face_psi_[n] = 0;
  }
}

void Semidiscrete::find_compact_faces(const double* y) {
  const std::size_t n = size();
  for (std::size_t f = 0; f <= n; ++f) {
    const bool left_edge = f == 0, right_edge = f == n;
    const std::size_t i = left_edge ? 0 : f - 1, j = right_edge ? n - 1 : f;
    const State l{phi_[i], psi_[i]}, r{phi_[j], psi_[j]};
    if (left_edge && setup_.left_free) {
      face_phi_[f] = r.phi - r.psi;
      face_psi_[f] = 0;
    } else if (right_edge && setup_.right_free) {
      face_phi_[f] = l.phi + l.psi;
      face_psi_[f] = 0;
    } else {
      face_phi_[f] = (l.phi + r.phi) / 2 + (l.psi - r.psi) / 2;
      face_psi_[f] = std::fmax((l.psi + r.psi) / 2 + (l.phi - r.phi) / 2, 0.0);
    }
    // Between two centres friction acts for the time that a wave needs from one to the other. With it the face carries
    // Darcy's flux, phi = -p_q / 8 C, where friction rules, and the plain Riemann solution where it does not.
    const double crossings = (rate_[i] + rate_[j]) * (y[2 * i] + y[2 * j]) / 4 / (sound_speed_[i] + sound_speed_[j]);
    face_phi_[f] /= 1 + crossings;
  }
}

void Semidiscrete::find_centres(const double* y) {
  const std::size_t n = size();
  double left = y[2 * n];
  for (std::size_t i = 0; i < n; ++i) {
    // x at the middle of s: the middle of the faces less what the widths' slope adds, (X_i+1 - X_i-1) / 16.
    const double bend = i > 0 && i + 1 < n && !compact_ ? (y[2 * i + 2] - y[2 * i - 2]) / 16 : 0;
    centres_[i] = left + y[2 * i] / 2 - bend;
    left += y[2 * i];
  }
}

namespace {

/// Coulomb friction on one cell that is pushed by `push`: opposes motion with `most`, or holds a cell that is at rest.
double coulomb(double momentum, double push, double most) {
  if (momentum != 0) return -std::copysign(most, momentum);
  return -std::copysign(std::fmin(std::fabs(push), most), push);
}

}  // namespace

void Semidiscrete::add_sources(double t, const double* y, double* dy) {
  const std::size_t n = size();
  const modulation::Friction& friction = setup_.friction;
  const bool frictional = friction.law != modulation::FrictionLaw::none && friction.coefficient > 0;
  const bool dry = frictional && friction.law == modulation::FrictionLaw::coulomb;
  const bool linear =
      friction.law == modulation::FrictionLaw::viscous && friction.closure == modulation::Closure::consistent;
  if (!frictional && !setup_.forcing) return;
  const std::vector<double>& charge = compact_ ? setup_.charge : charge_point_;
  double dissipation = 0, supply = 0;
  if (linear && !setup_.forcing) {  // the plain case, without the detour over point values
    dy[2 * n + 1] = damp(n, friction.coefficient, y, velocity_.data(), dy);
    return;
  }
  if (setup_.forcing) find_centres(y);
  for (std::size_t i = 0; i < n; ++i) {
    const double U = velocity_[i];
    source_[i] = 0;
    if (setup_.forcing) {
      const double push = 2 * pi * setup_.forcing(centres_[i], t) * charge[i];
      supply += U * push;
      source_[i] += push;
    }
    if (dry) {
      const double force = coulomb(y[2 * i + 1], dy[2 * i + 1] + source_[i], 2 * pi * friction.coefficient * charge[i]);
      dissipation -= U * force;
      source_[i] += force;
    } else if (frictional) {
      const double loss = rate_[i] * momentum_[i] * charge[i];
      dissipation += U * loss;
      if (!linear) source_[i] -= loss;
    }
  }
  // A cell held at rest by dry friction has no smooth source around it.
  const bool point_source = compact_ || dry;
  if (!point_source) cell_means(n, source_.data(), source_mean_.data());
  for (std::size_t i = 0; i < n; ++i) {
    dy[2 * i + 1] += point_source ? source_[i] : source_mean_[i];
    if (frictional && linear) dy[2 * i + 1] -= friction.coefficient * y[2 * i + 1];
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
      largest_rate_ = paper_rates(size(), f.coefficient, EK_.data(), rate_.data());
    }
    return;
  }
  largest_rate_ = 0;
  for (std::size_t i = 0; i < size(); ++i) {
    rate_[i] = modulation::relaxation_rate({phi_[i], psi_[i]}, f);
    largest_rate_ = std::max(largest_rate_, rate_[i]);
  }
}

void Semidiscrete::operator()(double t, const double* y, double* dy) {
  const std::size_t n = size();
  find_states(t, y);
  find_rates();
  if (compact_)
    find_compact_faces(y);
  else
    find_faces();
  face_fluxes(n + 1, face_phi_.data(), face_psi_.data(), face_U_.data(), face_p_.data());
  dy[2 * n] = face_U_[0];
  dy[2 * n + 1] = dy[2 * n + 2] = 0;
  differences(n, face_U_.data(), face_p_.data(), dy);
  add_sources(t, y, dy);
}

double Semidiscrete::crossing_time(const double* y, const double* dy) const {
  return least_crossing_time(size(), y, dy, velocity_.data(), sound_speed_.data());
}

double Semidiscrete::mean_crossing_time(const double* y) const {
  double width = 0, fastest = 0;
  for (std::size_t i = 0; i < size(); ++i) {
    width += y[2 * i];
    fastest = std::max(fastest, sound_speed_[i]);
  }
  return fastest > 0 ? width / static_cast<double>(size()) / fastest : HUGE_VAL;
}

}  // namespace slipfront::pulse
