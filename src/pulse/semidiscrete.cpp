#include "semidiscrete.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <utility>

#include "kernels.hpp"
#include "slipfront/elliptic/complete.hpp"
#include "slipfront/error.hpp"
#include "slipfront/modulation/per_dislocation.hpp"
#include "weno.hpp"

namespace slipfront::pulse {
namespace {

using std::numbers::pi;
constexpr std::size_t ghosts = 3;

}  // namespace

std::vector<Stretch> stretches_of(const std::vector<double>& charge, bool left_free, bool right_free) {
  std::vector<Stretch> stretches;
  for (std::size_t i = 0; i < charge.size(); ++i) {
    if (charge[i] == 0) continue;
    const bool opens = i == 0 || charge[i - 1] == 0;
    if (opens) stretches.push_back({i, i, i > 0 || left_free, true});
    stretches.back().end = i + 1;
  }
  stretches.back().right_free = right_free;
  return stretches;
}

void middles(const std::vector<Stretch>& stretches, const std::vector<double>& faces, std::vector<double>& centres) {
  for (std::size_t i = 0; i < centres.size(); ++i) centres[i] = (faces[i] + faces[i + 1]) / 2;
  for (const Stretch& stretch : stretches)
    for (std::size_t i = stretch.begin + 1; i + 1 < stretch.end; ++i) {
      const double* f = faces.data() + i;
      const bool inside = i >= stretch.begin + 2 && i + 2 < stretch.end;
      centres[i] = inside ? (150 * (f[0] + f[1]) - 25 * (f[-1] + f[2]) + 3 * (f[-2] + f[3])) / 256
                          : (9 * (f[0] + f[1]) - (f[-1] + f[2])) / 16;
    }
}

Semidiscrete::Semidiscrete(Setup setup)
    : setup_(std::move(setup)), stretches_(stretches_of(setup_.charge, setup_.left_free, setup_.right_free)) {
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
  for (auto* array : {&face_phi_, &face_psi_, &face_U_, &face_p_, &faces_}) array->assign(n + 1, 0);
  if (setup_.contact) {
    contact_.assign(n, 1);
    contact_force_.assign(n, 0);
    face_contact_.assign(n + 1, 1);
  }
  for (const Stretch& r : stretches_)
    centre_values(r.end - r.begin, setup_.charge.data() + r.begin, charge_point_.data() + r.begin);
  for (std::size_t i = 0; i < n; ++i) {
    if (gap(i)) {
      EK_[i] = HUGE_VAL;  // no friction there
      continue;
    }
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
    for (const Stretch& r : stretches_) {
      centre_values(r.end - r.begin, width_.data() + r.begin, spacing_.data() + r.begin);
      centre_values(r.end - r.begin, momentum_in_cell_.data() + r.begin, momentum_.data() + r.begin);
    }
  }
  for (std::size_t i = 0; i < n; ++i)
    if (!(spacing_[i] > 0)) spacing_[i] = width_[i];  // a last cell, much narrower than the ones beside it
  multiply(n, (compact_ ? per_charge_ : per_charge_point_).data(), spacing_.data(), momentum_.data());
  if (setup_.contact) {
    for (std::size_t i = 0; i < n; ++i) {
      spacing_[i] *= contact_[i];
      momentum_[i] /= contact_[i];
    }
  }
  for (const Stretch& r : stretches_) {
    const std::size_t i = r.begin;
    resolve_all({r.end - i, &spacing_[i], &momentum_[i], &s_[i], &phi_[i], &psi_[i], &sound_speed_[i], &EK_[i],
                 &velocity_[i], &good_[i]});
  }
  for (std::size_t i = 0; i < n; ++i) {
    if (good_[i] != 0 || gap(i)) continue;
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
  if (setup_.contact)
    for (std::size_t i = 0; i < n; ++i) momentum_[i] *= contact_[i];
}

void Semidiscrete::find_faces() {
  for (const Stretch& r : stretches_) {
    cell_means(r.end - r.begin, phi_.data() + r.begin, phi_mean_.data() + r.begin);
    cell_means(r.end - r.begin, psi_.data() + r.begin, psi_mean_.data() + r.begin);
  }
  for (const Stretch& r : stretches_) find_faces(r);
}

void Semidiscrete::find_faces(const Stretch& stretch) {
  const std::size_t n = stretch.end - stretch.begin;
  double* plus = invariant_plus_.data() + ghosts;
  double* minus = invariant_minus_.data() + ghosts;
  const double scale = invariants(n, phi_mean_.data() + stretch.begin, psi_mean_.data() + stretch.begin, plus, minus);
  for (std::size_t g = 1; g <= ghosts; ++g) {
    // Beyond a free edge psi = 0, and the edge moves at the invariant that reaches it.
    *(plus - g) = stretch.left_free ? minus[0] : plus[0];
    *(minus - g) = minus[0];
    plus[n - 1 + g] = plus[n - 1];
    minus[n - 1 + g] = stretch.right_free ? plus[n - 1] : minus[n - 1];
  }
  double* face_phi = face_phi_.data() + stretch.begin;
  double* face_psi = face_psi_.data() + stretch.begin;
  weno_faces(n + 1, plus, minus, scale, face_phi, face_psi);
  flatten_shocks(stretch, plus, minus, scale);
  // At a free edge psi = 0; phi + psi (or phi - psi) is the invariant that reaches it.
  if (stretch.left_free) {
    face_phi[0] = weno5(minus[2], minus[1], minus[0], minus[-1], minus[-2]) * scale;
    face_psi[0] = 0;
  }
  if (stretch.right_free) {
    const double* p = plus + n;
    face_phi[n] = weno5(p[-3], p[-2], p[-1], p[0], p[1]) * scale;
    face_psi[n] = 0;
  }
}

/// Where trains collide so hard that a shock stands, high order rings behind it: there faces fall back on the plain
/// values of the cells, as in the PPM of Colella & Woodward (1984). `plus` and `minus` are the scaled invariants.
void Semidiscrete::flatten_shocks(const Stretch& stretch, const double* plus, const double* minus, double scale) {
  constexpr double weak = 0.5, strong = 1;  // fall of phi over two cells, beside the mean of psi
  constexpr std::ptrdiff_t reach = 5;
  const auto n = static_cast<std::ptrdiff_t>(stretch.end - stretch.begin);
  for (std::ptrdiff_t i = 0; i < n; ++i) {
    const double fall = plus[i - 1] + minus[i - 1] - plus[i + 1] - minus[i + 1];
    const double density = plus[i - 1] - minus[i - 1] + plus[i + 1] - minus[i + 1];
    if (!(fall > weak * density)) continue;
    const double share = std::fmin((fall / density - weak) / (strong - weak), 1.0);
    for (std::ptrdiff_t f = std::max<std::ptrdiff_t>(i - reach + 1, 1); f <= std::min(i + reach, n - 1); ++f) {
      const std::size_t face = stretch.begin + static_cast<std::size_t>(f);
      const double a = plus[f - 1] * scale, b = minus[f] * scale;
      face_phi_[face] += share * ((a + b) / 2 - face_phi_[face]);
      face_psi_[face] += share * (std::fmax((a - b) / 2, 0.0) - face_psi_[face]);
    }
  }
}

void Semidiscrete::find_compact_faces(const double* y) {
  const std::size_t n = size();
  for (std::size_t f = 0; f <= n; ++f) {
    const bool left_edge = f == 0 || gap(f - 1), right_edge = f == n || gap(f);
    const std::size_t i = left_edge ? f : f - 1, j = right_edge ? f - 1 : f;
    const State l{phi_[i], psi_[i]}, r{phi_[j], psi_[j]};
    if (left_edge && (f > 0 || setup_.left_free)) {
      face_phi_[f] = r.phi - r.psi;
      face_psi_[f] = 0;
    } else if (right_edge && (f < n || setup_.right_free)) {
      face_phi_[f] = l.phi + l.psi;
      face_psi_[f] = 0;
    } else {
      face_phi_[f] = (l.phi + r.phi) / 2 + (l.psi - r.psi) / 2;
      face_psi_[f] = std::fmax((l.psi + r.psi) / 2 + (l.phi - r.phi) / 2, 0.0);
    }
    // Between two centres friction acts for the time that a wave needs from one to the other. With it the face carries
    // Darcy's flux, phi = -p_q / 8 C, where friction rules, and the plain Riemann solution where it does not.
    if (setup_.contact) {
      const double rise = left_edge    ? 2 * (contact_[j] - face_contact_[f])
                          : right_edge ? 2 * (face_contact_[f] - contact_[i])
                                       : contact_[j] - contact_[i];
      face_phi_[f] -= rise / (face_contact_[f] * (sound_speed_[i] + sound_speed_[j]));
    }
    const double crossings = (rate_[i] + rate_[j]) * (y[2 * i] + y[2 * j]) / 4 / (sound_speed_[i] + sound_speed_[j]);
    face_phi_[f] /= 1 + crossings;
  }
}

void Semidiscrete::find_places(const double* y) {
  const std::size_t n = size();
  faces_[0] = y[2 * n];
  for (std::size_t i = 0; i < n; ++i) faces_[i + 1] = faces_[i] + y[2 * i];
  if (compact_)
    for (std::size_t i = 0; i < n; ++i) centres_[i] = faces_[i] + y[2 * i] / 2;
  else
    middles(stretches_, faces_, centres_);
  if (!setup_.contact) return;
  for (std::size_t i = 0; i < n; ++i) contact_[i] = setup_.contact(centres_[i]);
  for (std::size_t f = 0; f <= n; ++f) face_contact_[f] = setup_.contact(faces_[f]);
}

namespace {

/// Coulomb friction on one cell that is pushed by `push`: opposes motion with `most`, or holds a cell that is at rest.
double coulomb(double momentum, double push, double most) {
  if (momentum != 0) return -std::copysign(most, momentum);
  return -std::copysign(std::fmin(std::fabs(push), most), push);
}

}  // namespace

namespace {

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
          -(left * (4 * b - 3 * a - c) + 4 * substrate(psi_[i]) * (c - a) + right * (a - 4 * b + 3 * c)) / 6;
    dy[2 * i + 1] += contact_force_[i];
    left = right;
  }
}

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
  for (std::size_t i = 0; i < n; ++i) {
    const double U = velocity_[i];
    source_[i] = 0;
    if (setup_.forcing) {
      const double push = 2 * pi * setup_.forcing(centres_[i], t) * charge[i];
      supply += U * push;
      source_[i] += push;
    }
    if (frictional && !dry) {
      const double loss = rate_[i] * momentum_[i] * charge[i];
      dissipation += U * loss;
      if (!linear) source_[i] -= loss;
    }
  }
  if (compact_)
    source_mean_ = source_;
  else
    for (const Stretch& r : stretches_)
      cell_means(r.end - r.begin, source_.data() + r.begin, source_mean_.data() + r.begin);
  for (std::size_t i = 0; i < n; ++i) {
    dy[2 * i + 1] += source_mean_[i];
    if (dry) {  // the same for each dislocation: no detour over point values
      const double force = coulomb(y[2 * i + 1], dy[2 * i + 1], 2 * pi * friction.coefficient * setup_.charge[i]);
      dissipation -= velocity_[i] * force;
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
      largest_rate_ = paper_rates(size(), f.coefficient, EK_.data(), rate_.data());
    }
    return;
  }
  largest_rate_ = 0;
  for (std::size_t i = 0; i < size(); ++i) {
    if (gap(i)) continue;
    rate_[i] = modulation::relaxation_rate({phi_[i], psi_[i]}, f);
    if (setup_.contact) rate_[i] *= std::pow(contact_[i], f.exponent - 1);  // <|w|^n sigma> over P, w in units of a
    largest_rate_ = std::max(largest_rate_, rate_[i]);
  }
}

void Semidiscrete::operator()(double t, const double* y, double* dy) {
  const std::size_t n = size();
  if (setup_.forcing || setup_.contact) find_places(y);
  find_states(t, y);
  find_rates();
  if (compact_)
    find_compact_faces(y);
  else
    find_faces();
  face_fluxes(n + 1, face_phi_.data(), face_psi_.data(), face_U_.data(), face_p_.data());
  for (std::size_t f = 0; f < face_contact_.size(); ++f) face_p_[f] *= face_contact_[f] * face_contact_[f];
  dy[2 * n] = face_U_[0];
  dy[2 * n + 1] = dy[2 * n + 2] = 0;
  differences(n, face_U_.data(), face_p_.data(), dy);
  if (setup_.contact) add_contact_force(dy);
  add_sources(t, y, dy);
}

double Semidiscrete::crossing_time(const double* y, const double* dy) const {
  double least = HUGE_VAL;
  for (const Stretch& r : stretches_) {
    const std::size_t i = r.begin;
    least = std::fmin(least, least_crossing_time(r.end - i, y + 2 * i, dy + 2 * i, &velocity_[i], &sound_speed_[i]));
  }
  if (setup_.contact)  // which may not throw a cell, of mass 8 a dislocation, farther than a part of its width
    for (std::size_t i = 0; i < size(); ++i)
      if (contact_force_[i] != 0)
        least = std::fmin(least, std::sqrt(4 * setup_.charge[i] * y[2 * i] / std::fabs(contact_force_[i])));
  return least;
}

double Semidiscrete::mean_crossing_time(const double* y) const {
  double width = 0, fastest = 0;
  for (std::size_t i = 0; i < size(); ++i) {
    if (gap(i)) continue;
    width += y[2 * i];
    fastest = std::max(fastest, sound_speed_[i]);
  }
  return fastest > 0 ? width / static_cast<double>(size()) / fastest : HUGE_VAL;
}

}  // namespace slipfront::pulse
