#include "semidiscrete.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <utility>

#include "slipfront/error.hpp"
#include "slipfront/modulation/characteristics.hpp"
#include "slipfront/modulation/per_dislocation.hpp"
#include "slipfront/train/train.hpp"
#include "weno.hpp"

namespace slipfront::pulse {
namespace {

using std::numbers::pi;
constexpr std::size_t ghosts = 3;

/// Second difference of f over 24, the step between a cell's average and its centre value to fourth order; zero where
/// the fourth difference is no smaller than the second: there f is not smooth on the grid, and average and centre value
/// are the same to the order that is left.
template <class At>
double curvature(std::size_t i, std::size_t n, const At& f) {
  if (n < 5 || i < 2 || i + 3 > n) return 0;
  // One-sided towards the ends of the grid: the same stencil, shifted.
  const std::size_t c = std::clamp<std::size_t>(i, 2, n - 3);
  const double d0 = f(c - 2) - 2 * f(c - 1) + f(c), d1 = f(c - 1) - 2 * f(c) + f(c + 1),
               d2 = f(c) - 2 * f(c + 1) + f(c + 2);
  const double fourth = std::fabs(d0 - 2 * d1 + d2), second = std::fabs(d0) + 2 * std::fabs(d1) + std::fabs(d2);
  if (!(fourth < 0.5 * second)) return 0;
  const double shift = static_cast<double>(i) - static_cast<double>(c);  // extrapolate the second difference linearly
  return (d1 + shift * (d2 - d0) / 2) / 24;
}

}  // namespace

Semidiscrete::Semidiscrete(Setup setup) : setup_(std::move(setup)) {
  const std::size_t n = size();
  charge_point_.resize(n);
  const auto charge = [&](std::size_t i) { return setup_.charge[i]; };
  for (std::size_t i = 0; i < n; ++i) charge_point_[i] = charge(i) - curvature(i, n, charge);
  states_.assign(n, State{0, 0});
  resolved_.assign(n, {});
  for (auto* array : {&spacing_, &momentum_, &phi_, &psi_, &rate_, &source_, &centres_}) array->assign(n, 0);
  for (auto* array : {&invariant_plus_, &invariant_minus_}) array->assign(n + 2 * ghosts, 0);
  face_phi_.assign(n + 1, 0);
  face_psi_.assign(n + 1, 0);
}

void Semidiscrete::start_from(const std::vector<double>& psi) {
  for (std::size_t i = 0; i < size(); ++i) states_[i].psi = psi[i];
}

void Semidiscrete::find_states(double t, const double* y) {
  const std::size_t n = size();
  for (std::size_t i = 0; i < n; ++i) {
    if (compact_) {
      spacing_[i] = y[2 * i] / setup_.charge[i];
      momentum_[i] = y[2 * i + 1] / setup_.charge[i];
    } else {
      spacing_[i] = (y[2 * i] - curvature(i, n, [y](std::size_t j) { return y[2 * j]; })) / charge_point_[i];
      momentum_[i] = (y[2 * i + 1] - curvature(i, n, [y](std::size_t j) { return y[2 * j + 1]; })) / charge_point_[i];
    }
    try {
      resolved_[i] = modulation::resolve({spacing_[i], momentum_[i]}, states_[i].psi);
      states_[i] = resolved_[i].state;
    } catch (const NumericsError& error) {
      throw NumericsError("t = " + std::to_string(t) + ", cell " + std::to_string(i) + " of " + std::to_string(n) +
                          ": " + error.what());
    }
  }
  if (compact_) return;
  for (std::size_t i = 0; i < n; ++i) {
    phi_[i] = states_[i].phi + curvature(i, n, [&](std::size_t j) { return states_[j].phi; });
    psi_[i] = states_[i].psi + curvature(i, n, [&](std::size_t j) { return states_[j].psi; });
  }
}

void Semidiscrete::find_faces() {
  const std::size_t n = size();
  double* plus = invariant_plus_.data() + ghosts;
  double* minus = invariant_minus_.data() + ghosts;
  double scale = 0;  // invariants are scaled to 1, so that squares of 1e-300 do not underflow
  for (std::size_t i = 0; i < n; ++i) scale = std::fmax(scale, std::fabs(phi_[i]) + psi_[i]);
  const double inverse = scale > 0 ? 1 / scale : 1;
  for (std::size_t i = 0; i < n; ++i) {
    plus[i] = (phi_[i] + psi_[i]) * inverse;
    minus[i] = (phi_[i] - psi_[i]) * inverse;
  }
  for (std::size_t g = 1; g <= ghosts; ++g) {
    // Beyond a free edge psi = 0, and the edge moves at the invariant that reaches it.
    *(plus - g) = setup_.left_free ? minus[0] : plus[0];
    *(minus - g) = minus[0];
    plus[n - 1 + g] = plus[n - 1];
    minus[n - 1 + g] = setup_.right_free ? plus[n - 1] : minus[n - 1];
  }
  for (std::size_t f = 0; f <= n; ++f) {
    const double* p = plus + f;  // p[-1] is the cell left of the face
    const double* m = minus + f;
    double from_left = weno5(p[-3], p[-2], p[-1], p[0], p[1]);
    double from_right = weno5(m[2], m[1], m[0], m[-1], m[-2]);
    if (f == 0 && setup_.left_free) from_left = from_right;
    if (f == n && setup_.right_free) from_right = from_left;
    const double psi = std::fmax((from_left - from_right) / 2, 0.0);
    const double phi = (from_left + from_right) / 2;
    face_phi_[f] = phi * scale;
    face_psi_[f] = psi * scale;
  }
}

void Semidiscrete::find_compact_faces(const double* y) {
  const std::size_t n = size();
  for (std::size_t f = 0; f <= n; ++f) {
    const bool left_edge = f == 0, right_edge = f == n;
    const State& l = states_[left_edge ? 0 : f - 1];
    const State& r = states_[right_edge ? n - 1 : f];
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
    const std::size_t i = left_edge ? 0 : f - 1, j = right_edge ? n - 1 : f;
    const double crossings =
        (rate_[i] + rate_[j]) * (y[2 * i] + y[2 * j]) / 4 / (resolved_[i].sound_speed + resolved_[j].sound_speed);
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
  if (setup_.forcing) find_centres(y);
  for (std::size_t i = 0; i < n; ++i) {
    const double U = std::tanh(states_[i].phi);
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
  for (std::size_t i = 0; i < n; ++i) {
    dy[2 * i + 1] += source_[i];
    // A cell held at rest by dry friction has no smooth source around it.
    if (!compact_ && !dry) dy[2 * i + 1] += curvature(i, n, [&](std::size_t j) { return source_[j]; });
    if (frictional && linear) dy[2 * i + 1] -= friction.coefficient * y[2 * i + 1];
  }
  // M = 2 pi P / k and 2 pi q_s = k x_s: the sums are over P dx = M q_s ds.
  dy[2 * n + 1] = dissipation;
  dy[2 * n + 2] = supply;
}

double Semidiscrete::rate_of(const modulation::Resolved& at) const {
  const modulation::Friction& f = setup_.friction;
  if (f.law != modulation::FrictionLaw::viscous) return modulation::relaxation_rate(at.state, f);
  // What relaxation_rate does, with the K and E that are known already.
  return f.closure == modulation::Closure::consistent || at.state.empty() ? f.coefficient
                                                                          : f.coefficient * pi * pi / (4 * at.EK);
}

void Semidiscrete::operator()(double t, const double* y, double* dy) {
  const std::size_t n = size();
  find_states(t, y);
  largest_rate_ = 0;
  for (std::size_t i = 0; i < n; ++i) {
    rate_[i] = rate_of(resolved_[i]);
    largest_rate_ = std::fmax(largest_rate_, rate_[i]);
  }
  if (compact_)
    find_compact_faces(y);
  else
    find_faces();
  std::fill(dy + 2 * n, dy + 2 * n + extra, 0.0);
  double U = std::tanh(face_phi_[0]), p = modulation::pressure(face_psi_[0]);
  dy[2 * n] = U;
  for (std::size_t i = 0; i < n; ++i) {
    const double next_U = std::tanh(face_phi_[i + 1]), next_p = modulation::pressure(face_psi_[i + 1]);
    dy[2 * i] = next_U - U;
    dy[2 * i + 1] = p - next_p;
    U = next_U;
    p = next_p;
  }
  add_sources(t, y, dy);
}

double Semidiscrete::crossing_time(const double* y) const {
  double least = HUGE_VAL;
  for (std::size_t i = 0; i < size(); ++i) {
    if (states_[i].empty()) continue;
    const double U = std::tanh(states_[i].phi), c0 = resolved_[i].sound_speed;
    const double fastest = c0 * (1 - U * U) / (1 - std::fabs(U) * c0);  // |lambda_pm - U|
    least = std::fmin(least, y[2 * i] / fastest);
  }
  return least;
}

double Semidiscrete::mean_crossing_time(const double* y) const {
  double width = 0, fastest = 0;
  for (std::size_t i = 0; i < size(); ++i) {
    width += y[2 * i];
    fastest = std::fmax(fastest, resolved_[i].sound_speed);
  }
  return fastest > 0 ? width / static_cast<double>(size()) / fastest : HUGE_VAL;
}

}  // namespace slipfront::pulse
