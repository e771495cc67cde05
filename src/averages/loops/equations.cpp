#include "averages/loops/equations.hpp"

#include <algorithm>
#include <string>

#include "averages/loops/loops.hpp"
#include "math/digits.hpp"
#include "math/weno.hpp"
#include "slipfront/error.hpp"
#include "slipfront/theory/modulation/modulation.hpp"
#include "theory/modulation/equations.hpp"
#include "theory/modulation/modulation.hpp"

namespace slipfront::plane {

bool Loops::innermost_vanishes() const {
  constexpr double nearly = 1e-3;  // fraction of the distance of the outermost loop
  const std::size_t inner = rows * angles;
  for (std::size_t k = 0; k < angles; ++k)
    if (!(r[inner + k] > nearly * r[k])) return true;
  return false;
}

void Loops::remove_innermost() {
  --rows;
  label.resize(rows + 1);
  r.resize((rows + 1) * angles);
  momentum.resize(cells());
  s.resize(cells());
  loss.resize(cells());
  limit = 0;
}

using std::numbers::pi;

namespace {

/// J0 cosh(phi) of a train, from E K and the spacing along its normal: l = 2 K / (cosh phi cosh psi).
double stiffness(double EK, double normal_spacing) { return 8 * EK / (pi * normal_spacing); }

/// Energy density H0 = kappa J0 - p of the train in its frame. kappa = 2 pi / (l cosh phi).
double energy_density(double EK, double normal_spacing, double velocity, double psi) {
  const double slowed = (1 - velocity) * (1 + velocity);  // 1 / cosh^2 phi
  return 16 * EK / (normal_spacing * normal_spacing) * slowed - modulation::pressure(psi);
}

/// Average of 1 - cos u over the train in its frame: kappa J0 / 2 - p.
double substrate(double EK, double normal_spacing, double velocity, double psi) {
  const double slowed = (1 - velocity) * (1 + velocity);
  return 8 * EK / (normal_spacing * normal_spacing) * slowed - modulation::pressure(psi);
}

}  // namespace

LoopEquations::LoopEquations(const Problem& problem, const Loops& loops)
    : problem_(problem),
      rows_(loops.rows),
      angles_(loops.angles),
      turn_(loops.turn()),
      label_(loops.label),
      wall_(loops.wall) {
  for (std::size_t k = 0; k < angles_; ++k) {
    cosine_.push_back(std::cos(loops.angle(k)));
    sine_.push_back(std::sin(loops.angle(k)));
  }
  for (auto* array : {&middle_, &spacing_, &bend_, &normal_spacing_, &normal_momentum_, &phi_, &psi_, &sound_, &EK_,
                      &velocity_, &along_ray_, &solved_, &log_psi_})
    array->assign(rows_ * angles_, 0);
  for (auto* array : {&face_bend_, &face_phi_, &face_psi_}) array->assign((rows_ + 1) * angles_, 0);
  stiffness_.assign(angles_, 0);
  tension_.assign(angles_, 0);
  if (problem_.contact) {
    contact_.assign(rows_ * angles_, 1);
    face_contact2_.assign((rows_ + 1) * angles_, 1);
  }
}

std::size_t LoopEquations::around(std::size_t k, int step) const {
  const auto n = static_cast<std::ptrdiff_t>(angles_);
  return static_cast<std::size_t>((static_cast<std::ptrdiff_t>(k) + step + n) % n);
}

void LoopEquations::derivative(const double* row, double* slope) const {
  if (angles_ == 1) return;
  for (std::size_t k = 0; k < angles_; ++k)
    slope[k] = (8 * (row[around(k, 1)] - row[around(k, -1)]) - (row[around(k, 2)] - row[around(k, -2)])) / (12 * turn_);
}

void LoopEquations::find_shapes(const std::vector<double>& r) {
  for (std::size_t row = 0; row <= rows_; ++row) {
    derivative(&r[face(row, 0)], &face_bend_[face(row, 0)]);
    for (std::size_t k = 0; k < angles_; ++k) face_bend_[face(row, k)] /= r[face(row, k)];
  }
  for (std::size_t row = 0; row < rows_; ++row) {
    const double charge = label_[row + 1] - label_[row];
    for (std::size_t k = 0; k < angles_; ++k) {
      const std::size_t i = face(row, k), inner = i + angles_;
      middle_[i] = (r[i] + r[inner]) / 2;
      spacing_[i] = (r[i] - r[inner]) / charge;
    }
    derivative(&middle_[face(row, 0)], &bend_[face(row, 0)]);
    for (std::size_t k = 0; k < angles_; ++k) {
      const std::size_t i = face(row, k);
      bend_[i] /= middle_[i];
      normal_spacing_[i] = spacing_[i] / std::sqrt(1 + bend_[i] * bend_[i]);
    }
  }
}

void LoopEquations::find_contacts(const std::vector<double>& r) {
  if (!problem_.contact) return;
  for (std::size_t i = 0; i < r.size(); ++i) {
    const std::size_t k = i % angles_;
    const double a = problem_.contact(r[i] * cosine_[k], r[i] * sine_[k]);
    face_contact2_[i] = a * a;
  }
  for (std::size_t i = 0; i < middle_.size(); ++i) {
    const Point at = centre(i);
    contact_[i] = problem_.contact(at.x, at.y);
    normal_spacing_[i] *= contact_[i];  // in the local units a x, a t
    normal_momentum_[i] /= contact_[i];
  }
}

void LoopEquations::solve(double t, std::vector<double>& s) {
  modulation::solve_states({s.size(), normal_spacing_.data(), normal_momentum_.data(), s.data(), phi_.data(),
                            psi_.data(), sound_.data(), EK_.data(), velocity_.data(), solved_.data()});
  for (std::size_t i = 0; i < s.size(); ++i) {
    if (solved_[i] != 0) continue;
    const auto where = [&] {
      const Point at = centre(i);
      return "t = " + digits(t) + ", x = " + digits(at.x, 4) + ", y = " + digits(at.y, 4) + ": ";
    };
    if (!(normal_spacing_[i] > 0))
      throw NumericsError(where() +
                          "dislocation lines cross; more or fewer loops, the solver \"grid\" or a direct run "
                          "may help");
    try {
      const double guess = std::atanh(std::fmin(std::fmax(s[i], 1e-300), 1 - 1e-16));
      const modulation::SolvedState at = modulation::solve_state({normal_spacing_[i], normal_momentum_[i]}, guess);
      phi_[i] = at.state.phi;
      psi_[i] = std::fmax(at.state.psi, 1e-303);
      s[i] = std::tanh(psi_[i]);
      sound_[i] = at.sound_speed;
      EK_[i] = at.EK;
      velocity_[i] = std::tanh(at.state.phi);
    } catch (const NumericsError& error) {
      throw NumericsError(where() + error.what());
    }
  }
}

/// Limited difference of f between neighbouring rows.
double LoopEquations::slope(const std::vector<double>& f, std::size_t row, std::size_t k) const {
  const std::size_t i = face(row, k);
  if (rows_ == 1) return 0;
  if (row == 0) return f[i + angles_] - f[i];
  if (row == rows_ - 1) return f[i] - f[i - angles_];
  return limited(f[i] - f[i - angles_], f[i + angles_] - f[i]);
}

/// phi and psi at a side of a cell: psi varies as an exponential, so that its logarithm is what varies linearly.
LoopEquations::Side LoopEquations::outer_side(std::size_t row, std::size_t k) const {
  const std::size_t i = face(row, k);
  return {phi_[i] - slope(phi_, row, k) / 2, std::exp(log_psi_[i] - slope(log_psi_, row, k) / 2)};
}
LoopEquations::Side LoopEquations::inner_side(std::size_t row, std::size_t k) const {
  const std::size_t i = face(row, k);
  return {phi_[i] + slope(phi_, row, k) / 2, std::exp(log_psi_[i] + slope(log_psi_, row, k) / 2)};
}

/// The outermost loop has nothing in front of it: psi = 0, and the invariant phi + psi arrives from inside.
void LoopEquations::find_outer_face(std::size_t k) {
  const Side inside = outer_side(0, k);
  face_phi_[k] = inside.phi + inside.psi;
  face_psi_[k] = 0;
}

/// The innermost loop rests on the held region as long as it is pressed onto it. Otherwise it moves freely.
void LoopEquations::find_inner_face(const std::vector<double>& r, std::size_t k) {
  const std::size_t i = face(rows_, k);
  const Side outside = inner_side(rows_ - 1, k);
  const double minus = outside.phi - outside.psi;
  const bool on_wall = wall_[k] > 0 && r[i] <= wall_[k] * (1 + 1e-12) && minus < 0;
  face_phi_[i] = on_wall ? 0 : minus;
  face_psi_[i] = on_wall ? -minus : 0;
}

/// States at the faces by the two-fan solution: phi + psi from the inner cell, phi - psi from the outer one.
void LoopEquations::find_faces(const std::vector<double>& r, std::vector<double>& r_rate) {
  for (std::size_t i = 0; i < psi_.size(); ++i) log_psi_[i] = std::log(psi_[i]);
  for (std::size_t k = 0; k < angles_; ++k) {
    find_outer_face(k);
    find_inner_face(r, k);
  }
  for (std::size_t row = 1; row < rows_; ++row) {
    for (std::size_t k = 0; k < angles_; ++k) {
      const Side inside = outer_side(row, k), outside = inner_side(row - 1, k);
      const double plus = inside.phi + inside.psi, minus = outside.phi - outside.psi;
      face_phi_[face(row, k)] = (plus + minus) / 2;
      face_psi_[face(row, k)] = std::fmax((plus - minus) / 2, 0.0);
    }
  }
  for (std::size_t i = 0; i < r.size(); ++i)
    r_rate[i] = modulation::velocity(face_phi_[i]) * std::sqrt(1 + face_bend_[i] * face_bend_[i]);
}

void LoopEquations::add_pressure(const std::vector<double>& r, std::vector<double>& rate) const {
  const auto push = [&](std::size_t i) {
    const double a2 = contact_.empty() ? 1 : face_contact2_[i];
    return a2 * r[i] * modulation::pressure(face_psi_[i]);
  };
  for (std::size_t row = 0; row < rows_; ++row) {
    const double charge = label_[row + 1] - label_[row];
    for (std::size_t k = 0; k < angles_; ++k) {
      const std::size_t i = face(row, k);
      const double a2 = contact(i) * contact(i);
      // Eq. (8.7): Pi_t = (r p)_q - l H0 + T_theta + g T + 2 pi r (F - <f>). The other terms are added below.
      rate[i] = (push(i + angles_) - push(i)) / charge -
                spacing_[i] * a2 * energy_density(EK_[i], normal_spacing_[i], velocity_[i], psi_[i]);
    }
  }
}

/// T between the angles and its difference, both of fourth order.
void LoopEquations::add_tension(std::vector<double>& rate) {
  if (angles_ == 1) return;
  for (std::size_t row = 0; row < rows_; ++row) {
    const std::size_t first = face(row, 0);
    const double* r = &middle_[first];
    for (std::size_t k = 0; k < angles_; ++k)
      stiffness_[k] = contact(first + k) * stiffness(EK_[first + k], normal_spacing_[first + k]);
    const auto between = [&](const double* f, std::size_t k) {
      return (9 * (f[k] + f[around(k, 1)]) - (f[around(k, -1)] + f[around(k, 2)])) / 16;
    };
    for (std::size_t k = 0; k < angles_; ++k) {
      const double turned =
          (27 * (r[around(k, 1)] - r[k]) - (r[around(k, 2)] - r[around(k, -1)])) / (24 * turn_ * between(r, k));
      tension_[k] = 2 * pi * between(stiffness_.data(), k) * turned / std::sqrt(1 + turned * turned);
    }
    for (std::size_t k = 0; k < angles_; ++k) {
      const double g = bend_[first + k];
      rate[first + k] +=
          (27 * (tension_[k] - tension_[around(k, -1)]) - (tension_[around(k, 1)] - tension_[around(k, -2)])) /
              (24 * turn_) +
          2 * pi * stiffness_[k] * g * g / std::sqrt(1 + g * g);
    }
  }
}

void LoopEquations::add_contact_force(std::vector<double>& rate) const {
  if (contact_.empty()) return;
  for (std::size_t i = 0; i < middle_.size(); ++i) {
    const double charge = label_[i / angles_ + 1] - label_[i / angles_];
    rate[i] += middle_[i] * substrate(EK_[i], normal_spacing_[i], velocity_[i], psi_[i]) *
               (face_contact2_[i + angles_] - face_contact2_[i]) / charge;
  }
}

void LoopEquations::add_forcing(double t, std::vector<double>& rate) {
  supply_ = 0;
  if (!problem_.forcing) return;
  for (std::size_t i = 0; i < middle_.size(); ++i) {
    const Point at = centre(i);
    const double push = modulation::force_per_dislocation(problem_.forcing(at.x, at.y, t)) * middle_[i];
    rate[i] += push;
    supply_ += push * along_ray_[i] * (label_[i / angles_ + 1] - label_[i / angles_]) * turn_;
  }
}

void LoopEquations::find_rates(double t, const std::vector<double>& r, const std::vector<double>& momentum,
                               std::vector<double>& s, std::vector<double>& r_rate,
                               std::vector<double>& momentum_rate) {
  find_shapes(r);
  for (std::size_t i = 0; i < momentum.size(); ++i) normal_momentum_[i] = momentum[i] / middle_[i];
  find_contacts(r);
  solve(t, s);
  find_faces(r, r_rate);
  for (std::size_t i = 0; i < velocity_.size(); ++i) along_ray_[i] = velocity_[i] * std::sqrt(1 + bend_[i] * bend_[i]);
  closing_ = 0;
  for (std::size_t i = 0; i < middle_.size(); ++i)
    closing_ = std::fmax(closing_, (r_rate[i + angles_] - r_rate[i]) / (r[i] - r[i + angles_]));
  for (std::size_t i = middle_.size() - angles_; i < middle_.size(); ++i)  // the innermost cells shrink to the origin
    closing_ = std::fmax(closing_, -(r_rate[i] + r_rate[i + angles_]) / (2 * middle_[i]));
  add_pressure(r, momentum_rate);
  add_tension(momentum_rate);
  add_contact_force(momentum_rate);
  add_forcing(t, momentum_rate);
}

/// A cell may lose 0.3 of its width, and an innermost cell 0.3 of its distance from the origin. Waves move through a
/// train with the speed c0 in its frame, and along a loop with the speed of light at most.
double LoopEquations::longest_step() const {
  double fastest = 0;
  for (std::size_t i = 0; i < phi_.size(); ++i) {
    const double U = std::fabs(velocity_[i]), c0 = sound_[i], bent = std::sqrt(1 + bend_[i] * bend_[i]);
    const double crossing =
        bent * c0 * (1 - U * U) / (1 - U * c0) / (spacing_[i] * (label_[i / angles_ + 1] - label_[i / angles_]));
    const double along = angles_ > 1 ? 1 / (middle_[i] * turn_) : 0;
    fastest = std::fmax(fastest, crossing + along);
  }
  return 1 / std::fmax(fastest, closing_ / 0.3);
}

}  // namespace slipfront::plane
